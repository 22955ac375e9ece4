# null_port.sh: copies platform/null to another name, as described in platform/README.md, and checks that the copy
# builds from its own source and runs, and that with an output it prints the host's hashes, with picture bytes between
# them. The copy is in a tree of links below BUILD. MAKE, BUILD in the environment.
. tests/scripts/checks.sh
tree=$BUILD/null-port-test
rm -rf "$tree"
mkdir -p "$tree/platform"
here=$(pwd)
for name in Makefile include src tests tools; do
    ln -s "$here/$name" "$tree/$name"
done
for folder in platform/*; do
    ln -s "$here/$folder" "$tree/$folder"
done
copy=$tree/platform/copied
cp -r platform/null "$copy"
chmod -R u+w "$copy" # the tree may be read-only
mv "$copy/port_null.c" "$copy/port_copied.c"

check "the copy builds" $MAKE -C "$tree" room PORT=copied BUILD=build
said=$($MAKE -C "$tree" run PORT=copied BUILD=build 2>&1)
check "it runs and says nothing: $said" test -z "$said"

# Adds an output, and rows of a picture, which end without a newline.
sed -e 's/^void port_put.*/#include <stdio.h>\nvoid port_put(const char *text) { fputs(text, stdout); }/' \
    -e 's/(void)user, (void)rgb, (void)width, (void)y, (void)rows;/(void)user, (void)rgb, (void)width, (void)rows;\n'\
'    if (y == 0)\n        fputs("P6 160 1 255\\n", stdout), fwrite("\\0\\1\\2", 1, 3, stdout), putchar(10);/' \
    platform/null/port_null.c >"$copy/port_copied.c"
check "the copy's own source counts: it is in the table, with the host's hashes" \
    $MAKE -C "$tree" ports PORTS=copied BUILD=build
finish
