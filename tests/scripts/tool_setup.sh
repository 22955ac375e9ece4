# tool_setup.sh: checks tools.sh get with a fake apt-get that only logs its arguments: no package is ever removed, and
# each step is printed. B in the environment.
. tests/scripts/checks.sh

case $B in /*) dir=$B/tool-setup ;; *) dir=$PWD/$B/tool-setup ;; esac
rm -rf "$dir"
mkdir -p "$dir/bin"

# Runs as root in every environment (fake `id`). `greedy-tool` would remove gcc, `lost-tool` does not exist.
printf '#!/bin/sh\necho 0\n' >"$dir/bin/id"
cat >"$dir/bin/apt-get" <<'END'
#!/bin/sh
echo "$*" >>"$TOLD"
case "$*" in
*lost-tool*) exit 100 ;;
*' -s '*greedy-tool*) echo 'Remv gcc-multilib [1]' ;;
*' -s '*) echo 'Inst plain-tool (1)' ;;
*greedy-tool*) touch "$TOLD.removed" ;;
esac
END
chmod +x "$dir/bin/id" "$dir/bin/apt-get"

get() {
    : >"$dir/told"
    TOLD=$dir/told PATH=$dir/bin:$PATH sh tests/scripts/tools.sh get "$@" >"$dir/said" 2>&1
}

# The installations, without simulations (-s).
installs() { grep install "$dir/told" | grep -v -e ' -s '; }

get plain-tool
check "plain-tool is not installed with --no-remove" test "$(installs)" = \
    "-q -y install --no-install-recommends --no-remove plain-tool"
check "the installation is not said" grep -q '^apt-get install .*plain-tool' "$dir/said"

get plain-tool greedy-tool lost-tool
check "something else than plain-tool is installed" test "$(installs)" = \
    "-q -y install --no-install-recommends --no-remove plain-tool"
check "a package would be removed" test ! -e "$dir/told.removed"
check "what is left out, and why, is not said" grep -q 'left out: greedy-tool.* gcc-multilib' "$dir/said"
check "what is not to be had is not said" grep -q 'not to be had: lost-tool' "$dir/said"

# A cross compiler without a libc finds no header.
printf '#!/bin/sh\nexec gcc "$@" -nostdinc\n' >"$dir/bin/bare-linux-gnu-gcc"
printf '#!/bin/sh\nexec gcc "$@"\n' >"$dir/bin/whole-linux-gnu-gcc"
chmod +x "$dir/bin/bare-linux-gnu-gcc" "$dir/bin/whole-linux-gnu-gcc"
get bare-linux-gnu-gcc whole-linux-gnu-gcc
check "a compiler without its libc does not count as missing" grep -q '^missing: bare-linux-gnu-gcc$' "$dir/said"

get sh
check "apt-get is asked though nothing is missing" test ! -s "$dir/told"

# Commands with which people install lambent.
case $(make -n install 2>&1) in
*tools.sh* | *apt-get*) fail "make install gets packages" ;;
*) pass ;;
esac
finish
