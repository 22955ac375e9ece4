# page.sed: turns links to folders and to files without a page into plain names, and shortens paths of images to names.
# A page begins with a table of contents. Removes code marks from titles, because doxygen would show them as tags.
s/(^|[^!])\[([^][]+)\]\(([^):#]+\/)?[^).:#\/]+\)/\1`\2`/g
s/(^|[^!])\[([^][]+)\]\([^):#]+\.(c|cpp|svg|txt|sh|mjs)\)/\1`\2`/g
s/\]\((\.\.\/)+tests\/results\/([a-z]+\.(png|svg))\)/](\2)/g
/^#+ /s/`//g
1a\
\
[TOC]
