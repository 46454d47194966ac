# libhalfshell (static; the shared one is in Install.cmake) and the program.

# The shared library shows only what the headers in include/halfshell mark.
set(CMAKE_C_VISIBILITY_PRESET hidden)

file(GLOB core_sources CONFIGURE_DEPENDS
  src/base/*.c src/core/*.c src/comm/*.c src/neighbor/*.c src/kernel/*.c src/style/*.c src/io/*.c src/sim/*.c src/deck/*.c
  src/parallel/messages.c src/parallel/parallel.c)
if(HALFSHELL_MPI)
  list(APPEND core_sources src/parallel/mpi_ranks.c src/parallel/mpi_messages.c)
else()
  list(APPEND core_sources src/parallel/mpi_none.c)
endif()
list(FILTER core_sources EXCLUDE REGEX
     "(cluster_search|near_places|settle|refine|histogram_kernel|noise_fill|motion|peak).c$")   # compiled for each instruction set, below
get_property(style_sources GLOBAL PROPERTY HALFSHELL_STYLE_SOURCES)
get_property(tables GLOBAL PROPERTY HALFSHELL_TABLES)

# Kernels: every file with an evaluator is compiled once more for each instruction set and precision (kernel/evaluator.h).
set(search_sources src/neighbor/cluster_search.c src/neighbor/near_places.c src/neighbor/settle.c src/kernel/refine.c src/kernel/histogram_kernel.c
    src/kernel/noise_fill.c src/kernel/motion.c src/kernel/peak.c)
set(evaluator_sources "")
foreach(source IN LISTS style_sources)
  file(STRINGS "${source}" has_evaluator REGEX "kernel/instantiate.h" LIMIT_COUNT 1)
  if(has_evaluator)
    list(APPEND evaluator_sources "${source}")
  endif()
endforeach()
set(kernel_isas portable)
set(kernel_flags_portable "")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT HALFSHELL_PORTABLE_ONLY)
  list(APPEND kernel_isas sse2 avx2 avx512)
  set(kernel_flags_sse2 -DHS_SIMD_SSE2)
  set(kernel_flags_avx2 -DHS_SIMD_AVX2 -mavx2 -mfma)
  set(kernel_flags_avx512 -DHS_SIMD_AVX512 -mavx2 -mfma -mbmi2 -mavx512f -mavx512dq -mavx512vl -mprefer-vector-width=512)
endif()
set(kernel_objects "")
foreach(isa IN LISTS kernel_isas)
  # the search is the same for both precisions
  add_library(halfshell_search_${isa} OBJECT ${search_sources})
  add_library(halfshell_kernels_${isa} OBJECT ${evaluator_sources})
  add_library(halfshell_kernels_${isa}_mixed OBJECT ${evaluator_sources})
  add_library(halfshell_kernels_${isa}_fixed OBJECT ${evaluator_sources})
  target_compile_definitions(halfshell_search_${isa} PRIVATE HS_KERNEL_ISA=${isa})
  target_compile_definitions(halfshell_kernels_${isa} PRIVATE HS_KERNEL_ISA=${isa})
  target_compile_definitions(halfshell_kernels_${isa}_mixed PRIVATE HS_KERNEL_ISA=${isa}_mixed HS_MIXED)
  target_compile_definitions(halfshell_kernels_${isa}_fixed PRIVATE HS_KERNEL_ISA=${isa}_fixed HS_FIXED)
  foreach(target halfshell_search_${isa} halfshell_kernels_${isa} halfshell_kernels_${isa}_mixed
          halfshell_kernels_${isa}_fixed)
    # without -g: debug information of hundreds of unrolled kernels is most of the library, and of the time to link it; line numbers
    # only for the sanitizers: all of it takes two fifths of the time to compile
    target_compile_options(${target} PRIVATE ${kernel_flags_${isa}} $<IF:$<CONFIG:Release>,-g0,-g1>)
    if(NOT target MATCHES "_search_")   # sums may begin with their first term instead of 0 plus it
      target_compile_options(${target} PRIVATE -fno-signed-zeros)
    endif()
    target_include_directories(${target} PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/src")
    if(HALFSHELL_FUZZ)   # readers are what fuzzers test; kernels are most of the time to build
      target_compile_options(${target} PRIVATE -O0 -g0 -fno-sanitize=all)
    endif()
    list(APPEND kernel_objects $<TARGET_OBJECTS:${target}>)
  endforeach()
endforeach()

add_library(halfshell_objects OBJECT ${core_sources} ${style_sources} ${tables})
target_include_directories(halfshell_objects PUBLIC "${CMAKE_CURRENT_SOURCE_DIR}/src" "${CMAKE_CURRENT_SOURCE_DIR}/include")
set(mpi_word "no MPI")
if(HALFSHELL_MPI)
  set(mpi_word "MPI")
endif()
target_compile_definitions(halfshell_objects PRIVATE HALFSHELL_VERSION="${PROJECT_VERSION}"
  HALFSHELL_BUILD="${CMAKE_C_COMPILER_ID} ${CMAKE_C_COMPILER_VERSION}, ${CMAKE_BUILD_TYPE}, ${mpi_word}")
target_link_libraries(halfshell_objects PUBLIC OpenMP::OpenMP_C PNG::PNG ZLIB::ZLIB PkgConfig::FFTW m)
target_link_libraries(halfshell_objects PRIVATE Halfshell::HDF5)
if(HALFSHELL_MPI)
  target_link_libraries(halfshell_objects PRIVATE MPI::MPI_C)
endif()

set_source_files_properties(src/core/noise.c PROPERTIES INCLUDE_DIRECTORIES "${RANDOM123_INCLUDE_DIR}")

add_library(halfshell_static STATIC $<TARGET_OBJECTS:halfshell_objects> ${kernel_objects})
target_link_libraries(halfshell_static PUBLIC OpenMP::OpenMP_C PNG::PNG ZLIB::ZLIB PkgConfig::FFTW m)
target_link_libraries(halfshell_static PRIVATE $<BUILD_INTERFACE:Halfshell::HDF5>)
target_link_libraries(halfshell_static INTERFACE $<INSTALL_INTERFACE:${HALFSHELL_HDF5_LINK}>)
target_include_directories(halfshell_static PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>)
if(HALFSHELL_MPI)
  target_link_libraries(halfshell_static PRIVATE MPI::MPI_C)
endif()

file(GLOB cli_sources CONFIGURE_DEPENDS src/cli/*.c)
add_executable(halfshell src/main.c ${cli_sources})
target_include_directories(halfshell PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/src")
target_compile_definitions(halfshell PRIVATE HALFSHELL_VERSION="${PROJECT_VERSION}")
target_link_libraries(halfshell PRIVATE halfshell_static)
