# The shared library, and what `cmake --install` puts where.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Only the public API is visible from outside: everything else may change between versions.
add_library(halfshell_shared SHARED $<TARGET_OBJECTS:halfshell_objects> ${kernel_objects})
target_link_libraries(halfshell_shared PRIVATE OpenMP::OpenMP_C PNG::PNG ZLIB::ZLIB PkgConfig::FFTW m)
target_link_libraries(halfshell_shared PRIVATE Halfshell::HDF5)
if(HALFSHELL_MPI)
  target_link_libraries(halfshell_shared PRIVATE MPI::MPI_C)
endif()
set_target_properties(halfshell_shared PROPERTIES VERSION "${PROJECT_VERSION}" SOVERSION "${PROJECT_VERSION_MAJOR}")
foreach(library shared static)
  set_target_properties(halfshell_${library} PROPERTIES OUTPUT_NAME halfshell EXPORT_NAME ${library})
  target_include_directories(halfshell_${library} INTERFACE $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
                             $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endforeach()

install(TARGETS halfshell RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
install(TARGETS halfshell_shared EXPORT HalfshellShared LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(TARGETS halfshell_static EXPORT HalfshellStatic ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(DIRECTORY include/halfshell DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.h")

# find_package(halfshell) gives halfshell::shared, which needs nothing else; with COMPONENTS static also halfshell::static,
# whose users link (and must have) the libraries under it.
set(config_dir "${CMAKE_INSTALL_LIBDIR}/cmake/halfshell")
configure_package_config_file(cmake/halfshell-config.cmake.in "${CMAKE_CURRENT_BINARY_DIR}/halfshell-config.cmake"
                              INSTALL_DESTINATION "${config_dir}")
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/halfshell-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/halfshell-config.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/halfshell-config-version.cmake" DESTINATION "${config_dir}")
install(EXPORT HalfshellShared NAMESPACE halfshell:: FILE halfshell-shared.cmake DESTINATION "${config_dir}")
install(EXPORT HalfshellStatic NAMESPACE halfshell:: FILE halfshell-static.cmake DESTINATION "${config_dir}")

# pkg-config halfshell; with --static it names what the static library needs.
set(pc_private "-lm -lpng -lz -lfftw3 ${OpenMP_C_FLAGS}")
foreach(word IN LISTS HALFSHELL_HDF5_LINK)
  string(APPEND pc_private " ${word}")
endforeach()
if(HALFSHELL_MPI)
  foreach(library IN LISTS MPI_C_LIBRARIES)
    string(APPEND pc_private " ${library}")
  endforeach()
endif()
# The prefix is found from the file's own place, so that the tree may be moved, or installed with --prefix.
file(RELATIVE_PATH pc_to_prefix "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
configure_file(cmake/halfshell.pc.in "${CMAKE_CURRENT_BINARY_DIR}/halfshell.pc" @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/halfshell.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")

install(FILES docs/halfshell.1 DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
install(FILES docs/completion/halfshell.bash DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
        RENAME halfshell)
install(FILES docs/completion/_halfshell DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions")
install(FILES README.md CHANGELOG.md LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY docs/reference DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY inputs DESTINATION "${CMAKE_INSTALL_DATADIR}/halfshell")
install(DIRECTORY examples DESTINATION "${CMAKE_INSTALL_DOCDIR}")
