# page_size.sh: checks that the page of platform/web compiles and links, and that a browser loads at most 300 KiB; MAKE
# BUILD in the environment.
. tests/scripts/checks.sh

bytes=$(${MAKE:-make} PORT=web BUILD="$BUILD/web" page-loads | awk '/bytes that a browser loads/ { print $1 }')
check "the page is built" test "${bytes:-0}" -gt 0
check "the page has $bytes bytes, of 307,200" test "${bytes:-307201}" -le 307200
finish
