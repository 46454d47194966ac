# One style is one file: src/FOLDER/NAME.c defines `const TYPE PREFIX_NAME`. From the names of the files this makes the
# tables through which the program finds them, so that a new style needs no edit elsewhere.
function(halfshell_style_table folder type prefix table header)
  file(GLOB files CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/src/${folder}/*.c")
  list(SORT files)
  set(declarations "")
  set(entries "")
  foreach(file IN LISTS files)
    get_filename_component(name "${file}" NAME_WE)
    string(APPEND declarations "extern const ${type} ${prefix}${name};\n")
    string(APPEND entries "    &${prefix}${name},\n")
  endforeach()
  file(CONFIGURE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/generated/table_${table}.c" @ONLY CONTENT
"/* Made by cmake/StyleTables.cmake from the files in src/${folder}/. */
#include \"${header}\"

${declarations}
const ${type} *const ${table}[] = {
${entries}    NULL,
};
")
  set_property(GLOBAL APPEND PROPERTY HALFSHELL_TABLES "${CMAKE_CURRENT_BINARY_DIR}/generated/table_${table}.c")
  set_property(GLOBAL APPEND PROPERTY HALFSHELL_STYLE_SOURCES ${files})
endfunction()

# Families of commands: src/deck/cmd_NAME.c defines `const hs_command hs_commands_NAME[]`.
function(halfshell_command_table)
  file(GLOB files CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/src/deck/cmd_*.c")
  list(SORT files)
  set(declarations "")
  set(entries "")
  foreach(file IN LISTS files)
    get_filename_component(name "${file}" NAME_WE)
    string(REPLACE "cmd_" "" name "${name}")
    string(APPEND declarations "extern const hs_command hs_commands_${name}[];\n")
    string(APPEND entries "    hs_commands_${name},\n")
  endforeach()
  file(CONFIGURE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/generated/table_commands.c" @ONLY CONTENT
"/* Made by cmake/StyleTables.cmake from the files src/deck/cmd_*.c. */
#include \"deck/command.h\"

${declarations}
const hs_command *const hs_command_families[] = {
${entries}    NULL,
};
")
  set_property(GLOBAL APPEND PROPERTY HALFSHELL_TABLES "${CMAKE_CURRENT_BINARY_DIR}/generated/table_commands.c")
endfunction()

halfshell_style_table(pair hs_pair_style hs_pair_style_ hs_pair_styles style/pair.h)
halfshell_style_table(fix hs_fix_style hs_fix_style_ hs_fix_styles style/fix.h)
halfshell_style_table(compute hs_compute_style hs_compute_style_ hs_compute_styles style/compute.h)
halfshell_style_table(region hs_region_style hs_region_style_ hs_region_styles style/region.h)
halfshell_style_table(dump hs_dump_style hs_dump_style_ hs_dump_styles style/dump.h)
halfshell_command_table()
