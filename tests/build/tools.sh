# tools.sh: the outside tools of the cross checks: tools.sh need COMMAND... | tools.sh install
#
# need: fails and names the missing commands with the Debian packages that have them.
# install: installs what is missing where apt-get and the right to use it are there; says what stays missing.
all="clang clang-sanitizers wasm-ld node aarch64-linux-gnu-gcc qemu-aarch64 mips-linux-gnu-gcc qemu-mips arm-none-eabi-gcc
    qemu-system-arm djpeg cjpeg pngtopam vips"

packages_of() {
    case $1 in
    aarch64-linux-gnu-gcc) echo gcc-aarch64-linux-gnu libc6-dev-arm64-cross ;;
    mips-linux-gnu-gcc) echo gcc-mips-linux-gnu libc6-dev-mips-cross ;;
    arm-none-eabi-gcc) echo gcc-arm-none-eabi ;;
    qemu-system-arm) echo qemu-system-arm ;;
    qemu-*) echo qemu-user ;;
    djpeg | cjpeg) echo libjpeg-turbo-progs ;;
    pngtopam) echo netpbm ;;
    vips) echo libvips-tools ;;
    clang-sanitizers) echo "libclang-rt-$(clang -dumpversion 2>/dev/null | cut -d. -f1)-dev" | sed 's/--/-14-/' ;;
    wasm-ld) echo lld ;;
    node) echo nodejs ;;
    *) echo "$1" ;;
    esac
}

# clang's sanitizers come in a package of their own: asked by linking a program with them.
sanitizes() {
    program=${TMPDIR:-/tmp}/sanitizes.$$
    echo 'int main(void) { return 0; }' | clang -x c -fsanitize=address,undefined -o "$program" - >/dev/null 2>&1
    found=$?
    rm -f "$program"
    return $found
}

missing() {
    for command in "$@"; do
        case $command in
        clang-sanitizers) sanitizes || echo "$command" ;;
        *) command -v "$command" >/dev/null 2>&1 || echo "$command" ;;
        esac
    done
}

packages() {
    for command in "$@"; do
        packages_of "$command"
    done | tr ' ' '\n' | sort -u | tr '\n' ' '
}

need() {
    lacking=$(missing "$@")
    [ -n "$lacking" ] || return 0
    echo "not installed:" $lacking "(Debian:" $(packages $lacking)")" >&2
    return 1
}

install() {
    lacking=$(missing $all)
    [ -n "$lacking" ] || return 0
    if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null 2>&1; then
        export DEBIAN_FRONTEND=noninteractive
        { apt-get -q update && apt-get -q -y install --no-install-recommends $(packages $lacking); } >/dev/null 2>&1
    fi
    need $all
    return 0
}

verb=$1
shift
"$verb" "$@"
