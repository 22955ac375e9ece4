# layout.sed: the names of the menu say what a reader looks for; all calls are in it. A header's page begins with what the
# header says of itself.
s/type="pages" visible="yes" title=""/type="pages" visible="yes" title="Guides"/
s/type="classes" visible="yes" title=""/type="classes" visible="yes" title="Structs"/
s/type="files" visible="yes" title=""/type="files" visible="yes" title="Headers"/
/type="pages"/a <tab type="user" url="@ref calls" title="All calls"/>
/<file>/,/<\/file>/{
/<detaileddescription/d
/<memberdecl>/i <detaileddescription title=""/>
}
