# layout.sed: gives menu entries the names that readers look for, and adds all calls. The page of a header begins with
# the header's first comment.
s/type="pages" visible="yes" title=""/type="pages" visible="yes" title="Guides"/
s/type="classes" visible="yes" title=""/type="classes" visible="yes" title="Structs"/
s/type="files" visible="yes" title=""/type="files" visible="yes" title="Headers"/
/type="pages"/a <tab type="user" url="@ref calls" title="All calls"/>
/<file>/,/<\/file>/{
/<detaileddescription/d
/<memberdecl>/i <detaileddescription title=""/>
}
