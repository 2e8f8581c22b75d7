# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# awk -f code_of_pages.awk PREAMBLE=FILE WITHOUT=REGEX PAGE.md...: one translation unit of all blocks fenced by ```cpp.
# A block of declarations is put into the namespace of its page, one of statements into a function; its #include lines go
# to the top. A block with a line that matches WITHOUT is left out. `<!-- given: CODE -->` on a page is code that is not shown.
# #line makes the compiler name page and line.

function at(line) { return "#line " line " \"" FILENAME "\"\n" }

function end_block(    k, declares, text) {
  for (k = 1; k <= count; ++k)
    if (WITHOUT != "" && code[k] ~ WITHOUT) return
  declares = -1
  for (k = 1; k <= count; ++k) {
    if (code[k] ~ /^[ \t]*#include/) {
      includes = includes at(first + k - 1) code[k] "\n"
      code[k] = ""
    } else if (declares < 0 && code[k] !~ /^[ \t]*(\/\/.*)?$/) {
      declares = code[k] ~ /^[ \t]*(struct|class|template|namespace|enum|using|inline|static|void)[ \t<]/
    }
    text = text code[k] "\n"
  }
  if (declares < 0) return  # includes alone
  ++blocks
  if (!declares) text = "void block_" blocks "() {\n" at(first) text "}"
  body = body at(first) text "\n"
}

FNR == 1 {
  if (pages++) body = body "}\n"
  body = body "namespace page_" pages " {\n"
  inside = 0
}
/^<!-- given: .* -->$/ { body = body at(FNR) substr($0, 13, length($0) - 16) "\n"; next }
!inside && /^[ \t]*```cpp[ \t]*$/ { inside = 1; count = 0; first = FNR + 1; next }
inside && /^[ \t]*```[ \t]*$/ { inside = 0; end_block(); next }
inside { code[++count] = $0 }
END { printf "%s#include \"%s\"\nnamespace documents {\n%s}\n}\n", includes, PREAMBLE, body }
