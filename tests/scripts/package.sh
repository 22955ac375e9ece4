# package.sh: checks that a program outside the tree builds after `make install`, with pkg-config and with CMake's
# find_package; that `make uninstall` leaves nothing; and that CMake's add_subdirectory builds the library from a clone.
# Each way builds and runs the same two programs of tests/examples. MAKE BUILD B CC CFLAGS in the environment.
. tests/scripts/checks.sh

# If make inherits these variables, it rebuilds everything and links the libraries twice.
unset LDLIBS FLAGS LIB TOOL
top=$PWD
dir=$(mktemp -d "${TMPDIR:-/tmp}/lambent-package.XXXXXX") || exit 1
trap 'rm -rf "$dir"' EXIT
root=$dir/root
prefix=/opt/lambent
version=$(awk '$2 ~ /^LMB_VERSION_(MAJOR|MINOR|PATCH)$/ { v = v dot $3; dot = "." } END { print v }' include/lambent/types.h)
cp tests/examples/depth_map.c tests/examples/golden_test.c tests/examples/room.h "$dir"

# runs DIRECTORY: checks that both programs there print the expected text.
runs() { "$1/depth_map" && "$1/golden_test"; }

# Installs as an administrator whose files nobody else may read.
check "make install" sh -c 'umask 077 && "$@"' sh "$MAKE" install BUILD="$BUILD" DESTDIR="$root" PREFIX=$prefix
kept=$(find "$root$prefix" ! -perm -0444 -o -type d ! -perm -0111)
check "everybody may read what is installed, but for: $kept" test -z "$kept"
(cd "$root" && find . -type f | sort) >"$dir/installed"
{
    for header in include/lambent/*.h; do echo ".$prefix/$header"; done
    printf ".$prefix/%s\n" bin/lambent share/man/man1/lambent.1 lib/liblambent.a lib/pkgconfig/lambent.pc \
        lib/cmake/lambent/lambent-config.cmake lib/cmake/lambent/lambent-config-version.cmake
} | sort >"$dir/expected"
check "what is installed" diff "$dir/expected" "$dir/installed"
check "the tool's version" test "$("$root$prefix/bin/lambent" --version)" = "lambent $version"

# Users of the library get the switches that it was built with.
check "lambent.pc of the tiny configuration" "$MAKE" "$dir/build/tiny/lambent.pc" BUILD="$dir/build" CONFIG=tiny \
    CFLAGS='-O2 -DLMB_VOXELS=0'
check "the tiny configuration's switches" grep -q '^Cflags: .* -DLMB_CONFIG_TINY -DLMB_VOXELS=0$' "$dir/build/tiny/lambent.pc"

if missing=$(sh tests/scripts/tools.sh need pkg-config 2>&1); then
    PKG_CONFIG_PATH=$root$prefix/lib/pkgconfig PKG_CONFIG_SYSROOT_DIR=$root
    export PKG_CONFIG_PATH PKG_CONFIG_SYSROOT_DIR
    check "pkg-config's version" test "$(pkg-config --modversion lambent)" = "$version"
    mkdir "$dir/by-pkg-config"
    for program in depth_map golden_test; do
        check "$program by pkg-config" sh -c 'cd "$1" && '"$CC"' $(pkg-config --cflags lambent) -o "by-pkg-config/$2" "$2.c" \
            $(pkg-config --libs lambent)' sh "$dir" $program
    done
    check "programs by pkg-config run" runs "$dir/by-pkg-config"
else
    skip "pkg-config: $missing"
fi

if missing=$(sh tests/scripts/tools.sh need cmake 2>&1); then
    for way in find_package add_subdirectory; do
        mkdir "$dir/$way"
        cat >"$dir/$way/CMakeLists.txt" <<CMAKE
cmake_minimum_required(VERSION 3.10)
project(user C)
$(case $way in
    find_package) echo "find_package(lambent \${WANTED} REQUIRED)" ;;
    *) echo "add_subdirectory(\"$top/platform/cmake\" lambent)" ;;
esac)
foreach(program depth_map golden_test)
    add_executable(\${program} ../\${program}.c)
    target_link_libraries(\${program} lambent::lambent)
endforeach()
CMAKE
    done
    configure() { # configure DIRECTORY SETTING...
        way=$1
        shift
        cmake -S "$dir/$way" -B "$dir/$way/build" -DCMAKE_C_COMPILER="$CC" -DCMAKE_PREFIX_PATH="$root$prefix" "$@"
    }
    check "find_package" configure find_package -DWANTED="${version%.*}"
    check "programs by find_package" cmake --build "$dir/find_package/build"
    check "programs by find_package run" runs "$dir/find_package/build"
    for other in 0.0 "${version%.*}.99" 7; do
        check "find_package finds version $other" sh -c '! "$@"' sh \
            cmake -S "$dir/find_package" -B "$dir/other-$other" -DCMAKE_PREFIX_PATH="$root$prefix" -DWANTED=$other
    done

    # -O0 takes seconds, and pixels do not depend on it. Without a build type it would be -O2.
    check "add_subdirectory" configure add_subdirectory -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
    check "a library without a build type is not optimised" grep -q -- '-O2 -ffp-contract=off.*/src/raster/fill\.c' \
        "$dir/add_subdirectory/build/compile_commands.json"
    # In one unit, so that file-local names of two sources may not be equal.
    check "add_subdirectory, Debug" configure add_subdirectory -DCMAKE_BUILD_TYPE=Debug -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 \
        -DCMAKE_C_FLAGS="-DLMB_HAVE_AVX512=0 -DLMB_HAVE_AVX2=0 -DLMB_HAVE_SSE2=0"
    check "programs by add_subdirectory" cmake --build "$dir/add_subdirectory/build"
    check "programs by add_subdirectory run" runs "$dir/add_subdirectory/build"
    check "tiny by add_subdirectory" configure add_subdirectory -DLAMBENT_CONFIG=tiny -DCMAKE_UNITY_BUILD=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
    check "the tiny configuration does not reach programs" grep -q 'DLMB_CONFIG_TINY.*depth_map\.c' \
        "$dir/add_subdirectory/build/compile_commands.json"
else
    skip "CMake: $missing"
fi

# A release: the same bytes from the same commit, and complete enough to build.
if git rev-parse -q --verify HEAD >/dev/null 2>&1; then
    for turn in 1 2; do
        check "make dist" "$MAKE" dist BUILD="$dir/dist$turn"
        [ $turn = 2 ] || sleep 1
    done
    check "make dist writes the same bytes twice" cmp "$dir/dist1/lambent-$version.tar.gz" "$dir/dist2/lambent-$version.tar.gz"
    (cd "$dir" && gzip -dc "dist1/lambent-$version.tar.gz" | tar xf -)
    check "a release lists its targets" "$MAKE" -C "$dir/lambent-$version" help
    check "a release has all sources" test "$(ls "$dir/lambent-$version"/src/*/*.c | wc -l)" -eq "$(git ls-files 'src/*.c' | wc -l)"
else
    skip "make dist: not a clone"
fi

bin=$root$prefix/bin/lambent-bench
check "make install-bench" sh -c 'umask 077 && "$@"' sh "$MAKE" install-bench BUILD="$BUILD" DESTDIR="$root" PREFIX=$prefix
check "everybody may run lambent-bench" test -n "$(find "$bin" -perm -0555)"
check "lambent-bench has a man page" grep -q '^.TH LAMBENT-BENCH 1 ' "$root$prefix/share/man/man1/lambent-bench.1"
check "lambent-bench's version" test "$("$bin" --version)" = "lambent-bench $version"
check "make uninstall" "$MAKE" uninstall BUILD="$BUILD" DESTDIR="$root" PREFIX=$prefix
check "what make uninstall leaves: $(cd "$root" && find . -type f)" test -z "$(find "$root" -type f)"
finish
