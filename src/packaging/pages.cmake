# cmake -DPAGES="a.md b.md" -DFOLDER=... -P pages.cmake: copies of pages in a folder, where links to what is not installed, "../...", are
# words alone.
separate_arguments(PAGES UNIX_COMMAND "${PAGES}")
foreach(page IN LISTS PAGES)
  file(READ ${page} text)
  string(REGEX REPLACE "\\[([^]]*)\\]\\(\\.\\./[^)]*\\)" "\\1" text "${text}")
  get_filename_component(name ${page} NAME)
  file(WRITE ${FOLDER}/${name} "${text}")
endforeach()
