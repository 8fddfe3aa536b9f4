# What `cmake --install` puts where, and the packages that `cpack` makes of it: a Debian package (-G DEB) and an archive
# that can be unpacked anywhere (-G TGZ).

# The CMake package.
include(CMakePackageConfigHelpers)
configure_package_config_file(Filters/ParticleOcclusionConfig.cmake.in ParticleOcclusionConfig.cmake
  INSTALL_DESTINATION "${cmake_destination}"
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(ParticleOcclusionConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(
  FILES       "${CMAKE_CURRENT_BINARY_DIR}/ParticleOcclusionConfig.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/ParticleOcclusionConfigVersion.cmake"
  DESTINATION "${cmake_destination}"
  COMPONENT   headers)

# Data and scripts: for ParaView in the folder that its file dialogs list as *Examples*.
if (PARTICLEOCCLUSION_WITH_PARAVIEW)
  set(examples_destination
    "${CMAKE_INSTALL_DATADIR}/paraview-${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}/examples/ParticleOcclusion")
else ()
  set(examples_destination "${CMAKE_INSTALL_DATADIR}/ParticleOcclusion")
endif ()
install(
  DIRECTORY   Data/
  DESTINATION "${examples_destination}"
  COMPONENT   examples
  FILES_MATCHING
    PATTERN "*.vtp"
    PATTERN "*.lammps"
    PATTERN "README.md"
    PATTERN "Examples/*.py"
    PATTERN "Examples/*.cxx"
    PATTERN "Examples/CMakeLists.txt"
    PATTERN "Pictures" EXCLUDE
    PATTERN "__pycache__" EXCLUDE)
# The documents with their pictures, in folders as here, so that their links lead somewhere.
set(documentation "${CMAKE_INSTALL_DATADIR}/doc/particleocclusion")
file(GLOB documents RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" CONFIGURE_DEPENDS
  *.md */README.md Testing/*/*.md Testing/Benchmarks/References/README.md CITATION.cff LICENSE
  Data/Pictures/*.png Testing/Benchmarks/*.png Filters/Core/*.svg)
foreach (document IN LISTS documents)
  cmake_path(GET document PARENT_PATH folder)
  install(FILES "${document}" DESTINATION "${documentation}/${folder}" COMPONENT documentation)
endforeach ()
install(
  FILES       LICENSE
  DESTINATION "${documentation}"
  RENAME      copyright
  COMPONENT   documentation)

# ParaView reads paraview.conf beside its executable: in the Debian package only, whose prefix is ParaView's own.
set(CPACK_COMPONENTS_ALL runtime headers python examples documentation)
if (PARTICLEOCCLUSION_WITH_PARAVIEW)
  file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/paraview.conf"
    "../${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}/ParticleOcclusion.plugins.xml\n")
  file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/conffiles" "/usr/bin/paraview.conf\n")
  install(
    FILES       "${CMAKE_CURRENT_BINARY_DIR}/paraview.conf"
    DESTINATION "${CMAKE_INSTALL_BINDIR}"
    COMPONENT   autoload
    EXCLUDE_FROM_ALL)
endif ()

set(CPACK_PROJECT_CONFIG_FILE "${CMAKE_CURRENT_LIST_DIR}/PackagingOptions.cmake")
set(CPACK_PACKAGE_NAME "particleocclusion")
set(CPACK_PACKAGE_CONTACT "ParticleOcclusion developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Baked ambient occlusion and ray-traced spheres for particles in ParaView")
set(CPACK_RESOURCE_FILE_LICENSE "${CMAKE_CURRENT_SOURCE_DIR}/LICENSE")
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_GENERATOR TGZ DEB)

string(TOLOWER "${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}" CPACK_SYSTEM_NAME)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# Of ParaView's own libraries the exact upstream version: a plugin fits no other.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_CURRENT_BINARY_DIR}/${library_destination}")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-paraview")
# What an administrator has written there already is not overwritten without asking.
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_BINARY_DIR}/conffiles")
include(CPack)
