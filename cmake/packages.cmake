# CPack: packages for Debian (a build with -DPELAGIC_DEBIAN=ON and the prefix /usr), and archives.
# release.sh builds and tests them. Equal sources give equal bytes if SOURCE_DATE_EPOCH is set.
set(PELAGIC_MAINTAINER "The Pelagic authors <pelagic@packages.invalid>" CACHE STRING "Maintainer of Debian's packages; the default's address is a placeholder")

set(CPACK_PACKAGE_CONTACT ${PELAGIC_MAINTAINER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "FFT ocean waves on the CPU")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_COMPONENTS_ALL runtime development tools)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
string(TOLOWER ${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR} package_system)
string(REGEX REPLACE "aarch64$" "arm64" package_system ${package_system})
set(CPACK_PACKAGE_FILE_NAME pelagic-${PROJECT_VERSION}-${package_system})
set(CPACK_GENERATOR TGZ)
if(WIN32)
  set(CPACK_GENERATOR ZIP)
endif()

if(PELAGIC_DEBIAN)
  set(library_package libpelagic${PROJECT_VERSION_MAJOR})
  set(version ${PROJECT_VERSION}-1)
  set(debian_folder ${PROJECT_BINARY_DIR}/debian)
  set(CPACK_GENERATOR DEB)
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${library_package})
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
  set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "Pelagic simulates FFT ocean waves on the CPU, multithreaded and vectorised,
with bit-identical results on every machine. This is its C interface, a shared
library.")
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${debian_folder}/shlibs ${debian_folder}/triggers)
  file(WRITE ${debian_folder}/shlibs "libpelagic_c ${PROJECT_VERSION_MAJOR} ${library_package} (>= ${PROJECT_VERSION})\n")
  file(WRITE ${debian_folder}/triggers "activate-noawait ldconfig\n")
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libpelagic-dev)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library_package} (= ${version})")
  if(PELAGIC_TBB)
    string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libtbb-dev")
  endif()
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS libglm-dev)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "libgles-dev, libegl-dev")
  set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "Headers, static libraries, and files for CMake and pkg-config: simulation,
quadtree mesh, forces on hulls, and rendering with OpenGL ES.")
  set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME pelagic)
  set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS "libegl1, libgles2, libgl1-mesa-dri")
  set(CPACK_DEBIAN_TOOLS_DESCRIPTION "The command pelagic exports looping maps and meshes of a sea, queries heights
at points, and renders images and films.")

  # The text of the Apache licence is on every Debian system.
  file(READ ${PROJECT_SOURCE_DIR}/LICENSE copyright)
  file(READ ${PROJECT_SOURCE_DIR}/NOTICE notice)
  string(FIND "${notice}" "\n                                 Apache License\n" apache_text)
  string(SUBSTRING "${notice}" 0 ${apache_text} notice)
  string(APPEND copyright "\n${notice}\nOn Debian systems the text is in /usr/share/common-licenses/Apache-2.0.\n")
  file(WRITE ${debian_folder}/copyright "${copyright}")
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
  foreach(component_and_package RUNTIME:${library_package} DEVELOPMENT:libpelagic-dev TOOLS:pelagic)
    string(REGEX MATCH "^(.*):(.*)$" component_and_package ${component_and_package})
    string(TOLOWER ${CMAKE_MATCH_1} component)
    set(package ${CMAKE_MATCH_2})
    file(WRITE ${debian_folder}/${package}/changelog.Debian
      "pelagic (${version}) stable; urgency=medium\n\n  * Version ${PROJECT_VERSION}: see CHANGELOG.md of the sources.\n\n -- ${PELAGIC_MAINTAINER}  ${date}\n")
    execute_process(COMMAND gzip -9nf ${debian_folder}/${package}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)
    install(FILES ${debian_folder}/copyright ${debian_folder}/${package}/changelog.Debian.gz
            DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
  endforeach()
  add_custom_command(OUTPUT ${debian_folder}/pelagic.1.gz
    COMMAND gzip -9nc ${PROJECT_BINARY_DIR}/manual/pelagic.1 > ${debian_folder}/pelagic.1.gz
    DEPENDS ${PROJECT_BINARY_DIR}/manual/pelagic.1 pelagic_manual_files)
  add_custom_target(pelagic_compressed_manual ALL DEPENDS ${debian_folder}/pelagic.1.gz)
  install(FILES ${debian_folder}/pelagic.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)
endif()

include(CPack)
