# libhalfshell (static and shared) and the program.
file(GLOB core_sources CONFIGURE_DEPENDS
  src/base/*.c src/core/*.c src/comm/*.c src/neighbor/*.c src/kernel/*.c src/style/*.c src/io/*.c src/sim/*.c src/deck/*.c
  src/parallel/parallel.c)
if(HALFSHELL_MPI)
  list(APPEND core_sources src/parallel/mpi_ranks.c)
else()
  list(APPEND core_sources src/parallel/mpi_none.c)
endif()
get_property(style_sources GLOBAL PROPERTY HALFSHELL_STYLE_SOURCES)
get_property(tables GLOBAL PROPERTY HALFSHELL_TABLES)

add_library(halfshell_objects OBJECT ${core_sources} ${style_sources} ${tables})
target_include_directories(halfshell_objects PUBLIC "${CMAKE_CURRENT_SOURCE_DIR}/src" "${CMAKE_CURRENT_SOURCE_DIR}/include")
target_link_libraries(halfshell_objects PUBLIC OpenMP::OpenMP_C m)
if(HALFSHELL_MPI)
  target_link_libraries(halfshell_objects PRIVATE MPI::MPI_C)
endif()

add_library(halfshell_static STATIC $<TARGET_OBJECTS:halfshell_objects>)
target_link_libraries(halfshell_static PUBLIC OpenMP::OpenMP_C m)
target_include_directories(halfshell_static PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>)
if(HALFSHELL_MPI)
  target_link_libraries(halfshell_static PRIVATE MPI::MPI_C)
endif()

file(GLOB cli_sources CONFIGURE_DEPENDS src/cli/*.c)
add_executable(halfshell src/main.c ${cli_sources})
target_include_directories(halfshell PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/src")
target_compile_definitions(halfshell PRIVATE HALFSHELL_VERSION="${PROJECT_VERSION}")
target_link_libraries(halfshell PRIVATE halfshell_static)
