# web_check.sh: checks the page of platform/web in headless Chromium; skipped, with the reason, if tools are missing.
#
# Gets playwright-core with npm if possible. Screenshots: BUILD/web/shots. MAKE BUILD PAGE_HASH in the environment.
skip() {
    echo "web-check: $1"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
}
for command in clang wasm-ld node npm xz; do
    command -v $command >/dev/null 2>&1 || skip "no $command"
done
[ -x "${CHROMIUM:-/usr/bin/chromium}" ] || skip "no Chromium: apt-get install chromium"
[ -e "${WASI:-/usr}/lib/wasm32-wasi/libc.a" ] || skip "no wasi-libc: apt-get install wasi-libc libclang-rt-14-dev-wasm32"
modules=$BUILD/web/modules
if [ ! -d "$modules/node_modules/playwright-core" ]; then
    mkdir -p "$modules"
    npm install --no-audit --no-fund --prefix "$modules" playwright-core >/dev/null 2>&1 || skip "npm gets no playwright-core"
fi
sh tests/scripts/page_size.sh && ${MAKE:-make} PORT=web BUILD="$BUILD/web" HOST_BUILD="$BUILD" page >/dev/null || exit 1
node tests/web/page_test.mjs "$BUILD/web/default/page" "$modules" "$PAGE_HASH" "$BUILD/web/shots"
