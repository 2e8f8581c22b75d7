# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# Links within a page become plain text: doxygen before 1.9.8 gives headings other names than the ones they have on GitHub.
s/\[([^]]*)\]\(#[^)]*\)/\1/g
# A text that began on the line before.
s/\]\(#[^)]*\)/]/g
