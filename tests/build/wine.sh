# wine.sh: runs a 64-bit Windows program: wine.sh PROGRAM.exe; Debian keeps wine64 out of PATH.
wine=$(command -v wine64 || echo /usr/lib/wine/wine64)
exec "$wine" "$@" 2>/dev/null
