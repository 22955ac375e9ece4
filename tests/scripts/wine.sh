# wine.sh: runs a 64-bit Windows program and converts the line ends: wine.sh PROGRAM.exe. Debian keeps wine64 out of
# PATH.
wine=$(command -v wine64 || echo /usr/lib/wine/wine64)
said=$("$wine" "$@" 2>/dev/null)
status=$?
printf '%s\n' "$said" | tr -d '\r'
exit $status
