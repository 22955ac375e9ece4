# page_size.sh: the page of platform/web compiles, links and is at most 300 KiB that a browser loads; MAKE BUILD in the
# environment.
. tests/scripts/checks.sh

bytes=$(${MAKE:-make} PORT=web BUILD="$BUILD/web" page-loads | awk '/bytes that a browser loads/ { print $1 }')
check "the page is built" test "${bytes:-0}" -gt 0
check "the page has $bytes bytes, of 307,200" test "${bytes:-307201}" -le 307200
finish
