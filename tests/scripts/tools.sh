# tools.sh: the external tools of the checks: tools.sh need COMMAND... | tools.sh get [COMMAND...]
#
# need: fails if commands are missing, and prints them with their Debian packages.
# get: installs missing commands, by default those that are usually needed, if apt-get is there and the user is root.
# Prints each step and the commands that stay missing. It never removes a package; if a package would remove another, it
# is left out.
all="clang clang-sanitizers wasm-ld wasi-libc node aarch64-linux-gnu-gcc qemu-aarch64 mips-linux-gnu-gcc qemu-mips
    arm-none-eabi-gcc arm-newlib qemu-system-arm riscv64-unknown-elf-gcc qemu-system-riscv32 djpeg cjpeg pngtopam vips
    cppcheck clang-tidy doxygen chromium cmake pkg-config tcc"

packages_of() {
    case $1 in
    aarch64-linux-gnu-gcc) echo gcc-aarch64-linux-gnu libc6-dev-arm64-cross ;;
    mips-linux-gnu-gcc) echo gcc-mips-linux-gnu libc6-dev-mips-cross ;;
    arm-linux-gnueabihf-gcc) echo gcc-arm-linux-gnueabihf libc6-dev-armhf-cross ;;
    arm-linux-gnueabi-gcc) echo gcc-arm-linux-gnueabi libc6-dev-armel-cross ;;
    mipsel-linux-gnu-gcc) echo gcc-mipsel-linux-gnu libc6-dev-mipsel-cross ;;
    powerpc-linux-gnu-gcc) echo gcc-powerpc-linux-gnu libc6-dev-powerpc-cross ;;
    powerpc64-linux-gnu-gcc) echo gcc-powerpc64-linux-gnu libc6-dev-ppc64-cross ;;
    powerpc64le-linux-gnu-gcc) echo gcc-powerpc64le-linux-gnu libc6-dev-ppc64el-cross ;;
    riscv64-linux-gnu-gcc) echo gcc-riscv64-linux-gnu libc6-dev-riscv64-cross ;;
    s390x-linux-gnu-gcc) echo gcc-s390x-linux-gnu libc6-dev-s390x-cross ;;
    sparc64-linux-gnu-gcc) echo gcc-sparc64-linux-gnu libc6-dev-sparc64-cross ;;
    m68k-linux-gnu-gcc) echo gcc-m68k-linux-gnu libc6-dev-m68k-cross ;;
    hppa-linux-gnu-gcc) echo gcc-hppa-linux-gnu libc6-dev-hppa-cross ;;
    gcc-m32) echo gcc-12-multilib libc6-dev-i386 ;;
    x86_64-w64-mingw32-gcc) echo gcc-mingw-w64-x86-64-win32 ;;
    arm-none-eabi-gcc) echo gcc-arm-none-eabi ;;
    arm-newlib) echo libnewlib-arm-none-eabi ;;
    qemu-system-arm) echo qemu-system-arm ;;
    riscv64-unknown-elf-gcc) echo gcc-riscv64-unknown-elf ;;
    qemu-system-riscv32) echo qemu-system-misc ;;
    qemu-system-aarch64) echo qemu-system-arm ;;
    libretro-* | dolphin-emu*) echo "${1%-nogui}" ;;
    mupen64plus) echo mupen64plus-ui-console mupen64plus-data ;;
    qemu-*) echo qemu-user ;;
    mednafen_psx_libretro.so) echo libretro-beetle-psx ;;
    Xvfb) echo xvfb ;;
    djpeg | cjpeg) echo libjpeg-turbo-progs ;;
    pngtopam) echo netpbm ;;
    vips) echo libvips-tools ;;
    clang-sanitizers) echo "libclang-rt-$(clang -dumpversion 2>/dev/null | cut -d. -f1)-dev" | sed 's/--/-14-/' ;;
    wasm-ld) echo lld ;;
    wasi-libc) echo wasi-libc libclang-rt-14-dev-wasm32 ;;
    node) echo nodejs ;;
    frama-c) echo frama-c-base ;;
    *) echo "$1" ;;
    esac
}

# clang's sanitizers are in a separate package. The test links a program with them.
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
        # A cross compiler may be installed without the libc.
        *-linux-gnu*-gcc) echo '#include <stdio.h>' | "$command" -E -x c -o /dev/null - >/dev/null 2>&1 \
            || echo "$command" ;;
        # The C library of bare Arm machines, for builds without headers of their own.
        arm-newlib) echo '#include <string.h>' | arm-none-eabi-gcc -E -x c -o /dev/null - >/dev/null 2>&1 \
            || echo "$command" ;;
        gcc-m32) echo 'int main(void) { return 0; }' | gcc -m32 -I/usr/include/x86_64-linux-gnu -x c -o /dev/null - \
            >/dev/null 2>&1 || echo "$command" ;;
        *_libretro.so) ls /usr/lib/*/libretro/"$command" >/dev/null 2>&1 || echo "$command" ;;
        libretro-mgba) ls /usr/lib/*/libretro/mgba_libretro.so >/dev/null 2>&1 || echo "$command" ;;
        libretro-desmume) ls /usr/lib/*/libretro/desmume_libretro.so >/dev/null 2>&1 || echo "$command" ;;
        libretro-beetle-psx) ls /usr/lib/*/libretro/mednafen_psx_libretro.so >/dev/null 2>&1 || echo "$command" ;;
        mupen64plus | dolphin-emu-nogui) PATH=$PATH:/usr/games command -v "$command" >/dev/null 2>&1 || echo "$command" ;;
        wasi-libc) [ -e /usr/lib/wasm32-wasi/libc.a ] && ls /usr/lib/llvm-*/lib/clang/*/lib/wasi/*wasm32.a >/dev/null 2>&1 \
            || echo "$command" ;;
        wine64) [ -x /usr/lib/wine/wine64 ] || command -v wine64 >/dev/null 2>&1 || echo "$command" ;;
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

# Prints the packages that apt-get would remove for these packages, from a simulation; "?" if some are not available.
removed_for() {
    if plan=$(apt-get -q -s install --no-install-recommends "$@" 2>&1); then
        printf '%s\n' "$plan" | sed -n 's/^Remv \([^ ]*\).*/\1/p'
    else
        echo '?'
    fi
}

# If the packages cannot be installed together, tries one at a time, so that only those that would remove others stay
# out.
add() {
    gone=$(removed_for "$@")
    if [ -z "$gone" ]; then
        echo "apt-get install --no-remove $*"
        apt-get -q -y install --no-install-recommends --no-remove "$@" >/dev/null 2>&1 || echo "apt-get failed for: $*"
    elif [ $# -gt 1 ]; then
        for package in "$@"; do
            add "$package"
        done
    elif [ "$gone" = '?' ]; then
        echo "not to be had: $1"
    else
        echo "left out: $1, for it would remove" $gone
    fi
}

get() {
    wanted=${*:-$all}
    lacking=$(missing $wanted)
    [ -n "$lacking" ] || return 0
    if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null 2>&1; then
        export DEBIAN_FRONTEND=noninteractive
        echo "missing:" $lacking
        echo "apt-get update"
        apt-get -q update >/dev/null 2>&1
        add $(packages $lacking)
    fi
    need $wanted
    return 0
}

verb=$1
shift
"$verb" "$@"
