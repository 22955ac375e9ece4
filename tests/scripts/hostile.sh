# hostile.sh: damaged copies of files through every parser: hostile.sh PROGRAM PREFIXES MUTATIONS [FILE...]
#
# Default files: the fuzz corpus and, if present, the sample data; fails if there are fewer than expected. Ends with the
# program's line `N passed, N failed, N skipped`.
program=$1 prefixes=$2 mutations=$3
shift 3
shared=${LMB_SHARED:-../shared}
corpus=${CORPUS:-tests/fuzz/corpus}

# The expected numbers of files. Raise them when you add files.
corpus_files=160 shared_files=66

# counted NAME PRESENT EXPECTED
counted() {
    [ "$2" -le "$3" ] || echo "note: $1: $2 files, $3 are expected; say $2 in tests/scripts/hostile.sh"
    [ "$2" -ge "$3" ] && return
    echo "FAIL $1: $2 files, $3 are expected: the list has shrunk"
    echo "0 passed, 1 failed, 0 skipped"
    exit 1
}

if [ $# -eq 0 ]; then
    for file in "$corpus"/*/*; do
        [ ! -f "$file" ] || set -- "$@" "$file"
    done
    own=$#
    counted "the corpus" $own $corpus_files
    for file in "$shared"/data/gltf/* "$shared"/data/meshes/* "$shared"/data/scenes/* \
        "$shared"/data/env/* "$shared"/data/textures/* "$shared"/truth/*.jpg "$shared"/truth/*/*.gltf; do
        [ ! -f "$file" ] || set -- "$@" "$file"
    done
    if [ -d "$shared/data" ]; then
        counted "the sample data" $(($# - own)) $shared_files
    else
        echo "skipped: the sample data: no $shared/data"
    fi
fi
ASAN_OPTIONS=abort_on_error=1:$ASAN_OPTIONS UBSAN_OPTIONS=print_stacktrace=1:$UBSAN_OPTIONS
export ASAN_OPTIONS UBSAN_OPTIONS
exec "$program" "$prefixes" "$mutations" "$@"
