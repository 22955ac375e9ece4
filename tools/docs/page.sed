# page.sed: links to folders and to files that are no pages become plain names, as the reference does not have them;
# pictures are found by their names. A page begins with its contents. Titles lose the marks of code, which doxygen would show as tags.
s/(^|[^!])\[([^][]+)\]\(([^):#]+\/)?[^).:#\/]+\)/\1`\2`/g
s/(^|[^!])\[([^][]+)\]\([^):#]+\.(c|cpp|svg|txt|sh|mjs)\)/\1`\2`/g
s/\]\((\.\.\/)+tests\/results\/([a-z]+\.(png|svg))\)/](\2)/g
/^#+ /s/`//g
1a\
\
[TOC]
