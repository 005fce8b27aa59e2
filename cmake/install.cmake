# cmake --install: libraries, the headers that hosts include, package files for CMake and pkg-config, and the tool.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/pelagic)

install(TARGETS pelagic_static pelagic_shared EXPORT pelagic)
install(EXPORT pelagic NAMESPACE pelagic:: DESTINATION ${package_folder} FILE pelagicTargets.cmake)

# The component that needs GLM. A host that doesn't ask for it needs no GLM either.
set_target_properties(pelagic_quadtree PROPERTIES EXPORT_NAME quadtree)
install(TARGETS pelagic_quadtree EXPORT pelagic_quadtree)
install(EXPORT pelagic_quadtree NAMESPACE pelagic:: DESTINATION ${package_folder} FILE pelagicQuadtreeTargets.cmake)

# The component that needs OpenGL ES headers too; it opens the driver at run time.
if(PELAGIC_GL)
  set_target_properties(pelagic_gl PROPERTIES EXPORT_NAME gl)
  install(TARGETS pelagic_gl EXPORT pelagic_gl)
  install(EXPORT pelagic_gl NAMESPACE pelagic:: DESTINATION ${package_folder} FILE pelagicGlTargets.cmake)
  set(gl_headers errors frame_textures functions headless_context objects render_target sea_renderer sky_baker views)
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/pelagicConfig.cmake.in
  ${PROJECT_BINARY_DIR}/package/pelagicConfig.cmake INSTALL_DESTINATION ${package_folder})
# A minor version may change the bits of the sea and, before 1.0, the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/pelagicConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/pelagicConfig.cmake ${PROJECT_BINARY_DIR}/package/pelagicConfigVersion.cmake
        DESTINATION ${package_folder})

# Relative to the .pc file, so that the tree can be moved.
file(RELATIVE_PATH pelagic_prefix_from_pkgconfig /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
set(pelagic_pc_requires)
set(pelagic_pc_definitions)
if(PELAGIC_TBB)
  set(pelagic_pc_requires "Requires: tbb")
  set(pelagic_pc_definitions " -DPELAGIC_HAS_TBB")
endif()
foreach(name pelagic pelagic_c)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/${name}.pc.in ${PROJECT_BINARY_DIR}/package/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/package/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

set(jobs_headers chrome_trace executor job_graph trace)
set(simd_headers isa)
set(sim_headers frame frame_buffers ocean sea_state statistics surface_query surface_query_jobs
                surface_ray)
set(quadtree_headers camera draw_list frustum level_map patch_mesh patch_vertex quadtree_options selection skirt stitching)
foreach(folder jobs simd sim quadtree gl)
  foreach(header IN LISTS ${folder}_headers)
    get_filename_component(inside ${folder}/${header} DIRECTORY)
    install(FILES ${PROJECT_SOURCE_DIR}/${folder}/${header}.hpp
            DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pelagic/${inside})
  endforeach()
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/capi/pelagic.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pelagic)

if(PELAGIC_TOOLS)
  install(TARGETS pelagic)
  install(TARGETS pelagic_images LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/pelagic)
endif()
