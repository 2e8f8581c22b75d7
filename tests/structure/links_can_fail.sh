#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# links_can_fail.sh WORK_FOLDER: links.sh accepts sound links and names each dead one.
set -euo pipefail
rules=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/links.sh
rm -rf "$1" && mkdir -p "$1/project/docs" "$1/project/build" && cd "$1/project"
touch ../outside.md picture.png
cat > README.md << 'PAGE'
# One page
[guide](docs/guide.md), [heading](docs/guide.md#two-words-v10), [again](docs/guide.md#twice-1), [here](#one-page)
[elsewhere](https://example.org/nowhere.md) [![picture](picture.png)](docs/ "a folder")
`[code](none.md)`
```sh
[code](none.md)
```
<img src="picture.png"> <a href="docs/guide.md#anchor">anchor</a>
[reference]: docs/guide.md
PAGE
cat > docs/guide.md << 'PAGE'
## Two `words`, v1.0
### Twice
### Twice
<a id="anchor"></a>
[back](../README.md)
PAGE
echo '[built](none.md)' > build/page.md
bash "$rules" . || { echo 'sound links were refused'; exit 1; }

cat >> README.md << 'PAGE'
[file](docs/none.md)
[heading](docs/guide.md#none) and [own heading](#none)
[outside](../outside.md)
<img src="none.png">
[other]: none.md
[![none](none.svg)](docs/guide.md)
PAGE
echo '[project, not page](docs/guide.md)' >> docs/guide.md
bash "$rules" . > ../found && { echo 'links are dead and nothing was said'; exit 1; }
diff - ../found << 'EXPECTED' || { echo 'expected (<) is not what was found (>)'; exit 1; }
README.md:10: dead link: docs/none.md
README.md:11: dead link: #none
README.md:11: dead link: docs/guide.md#none
README.md:12: dead link: ../outside.md
README.md:13: dead link: none.png
README.md:14: dead link: none.md
README.md:15: dead link: none.svg
docs/guide.md:6: dead link: docs/guide.md
EXPECTED
echo 'all dead links were found'
