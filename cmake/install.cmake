# cmake --install: libraries, public headers, package files for CMake and pkg-config, and the tool.
# The components are
#
#   runtime      the shared library, and licences
#   development  headers, static libraries, files for CMake and pkg-config
#   tools        the command, with its manual page, completion and presets
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/pelagic)

# A targets file for each component, so that an application needs only the packages of its
# components.
function(pelagic_install_component component target)
  install(TARGETS ${target} EXPORT pelagic_${component} ARCHIVE COMPONENT development
          RUNTIME COMPONENT runtime LIBRARY COMPONENT runtime NAMELINK_COMPONENT development)
  install(EXPORT pelagic_${component} NAMESPACE pelagic:: DESTINATION ${package_folder} FILE pelagic_${component}_targets.cmake)
endfunction()
pelagic_install_component(c pelagic_shared)
pelagic_install_component(cpp pelagic_static)
if(PELAGIC_FLOATING)
  set_target_properties(pelagic_floating PROPERTIES EXPORT_NAME floating)
  pelagic_install_component(floating pelagic_floating)
endif()
if(PELAGIC_QUADTREE)
  set_target_properties(pelagic_quadtree PROPERTIES EXPORT_NAME quadtree)
  pelagic_install_component(quadtree pelagic_quadtree)
endif()
if(PELAGIC_GL)
  set_target_properties(pelagic_gl PROPERTIES EXPORT_NAME gl)
  pelagic_install_component(gl pelagic_gl)
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/pelagicConfig.cmake.in
  ${PROJECT_BINARY_DIR}/package/pelagicConfig.cmake INSTALL_DESTINATION ${package_folder})
# A minor version may change a sea's reproducible values, but keeps the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/pelagicConfigVersion.cmake
  COMPATIBILITY SameMajorVersion)
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
# A C compiler links the static library if it gets the C++ library: pkg-config --static.
set(pelagic_pc_runtime ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(FILTER pelagic_pc_runtime INCLUDE REGEX "^(stdc\\+\\+|c\\+\\+|c\\+\\+abi|m)$")
list(REMOVE_DUPLICATES pelagic_pc_runtime)
list(TRANSFORM pelagic_pc_runtime PREPEND -l)
list(JOIN pelagic_pc_runtime " " pelagic_pc_runtime)
set(packages pelagic pelagic_c)
if(PELAGIC_FLOATING)
  list(APPEND packages pelagic_floating)
endif()
if(PELAGIC_QUADTREE)
  list(APPEND packages pelagic_quadtree)
endif()
foreach(name IN LISTS packages)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/${name}.pc.in ${PROJECT_BINARY_DIR}/package/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/package/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

set(message_headers enum_names numeric_field)
set(analytic_headers analytic_glsl analytic_sea analytic_surface pond_waves plane_waves)
set(jobs_headers chrome_trace executor job_graph sliced_executor trace)
set(simd_headers allocator isa)
set(sim_headers analytic_cascades cascade cascade_plan cascade_sum dispersion disturbance dynamic_waves dynamic_waves_view fixed_list foam_report forecast frame frame_bounds frame_buffers
                gerstner_input ocean pressure_footprint rain ripple_input sea_state sea_waves shore shore_surface slope_sum slope_variance snapshot_foam spray statistics surface_query
                exact_water water_jobs water_kinematics water_levels water_query
                surface_query_jobs surface_ray texture_targets water_frame wave_input)
set(floating_headers floating_bodies given_coefficients hull hull_matrix hull_mesh hull_plan hull_spray hull_wake radiation_table
                     wamit_files wave_forces)
set(quadtree_headers camera draw_list frustum level_map node_culling patch_mesh patch_vertex quadtree_options selection skirt stitching)
set(gl_headers application_scene display errors exposure functions headless_context light_meter objects pixel_ring render_target views
               sky/cloud_shadows sky/light_presets sky/sky sky/sky_baker
               water/camera_water_plane water/caustics water/exclusions water/frame_textures water/sea_floor water/sea_pass water/sea_renderer water/shading water/small_water
               water/water_optics)
set(folders message analytic jobs simd sim)
if(PELAGIC_FLOATING)
  list(APPEND folders floating)
endif()
if(PELAGIC_QUADTREE)
  list(APPEND folders quadtree)
endif()
if(PELAGIC_GL)
  list(APPEND folders gl)
endif()
foreach(folder IN LISTS folders)
  foreach(header IN LISTS ${folder}_headers)
    get_filename_component(inside ${folder}/${header} DIRECTORY)
    install(FILES ${PROJECT_SOURCE_DIR}/${folder}/${header}.hpp
            DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pelagic/${inside})
    list(APPEND installed_headers ${PROJECT_SOURCE_DIR}/${folder}/${header}.hpp)
  endforeach()
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/capi/pelagic.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pelagic)

# Debian's packages have copies of their own (packages.cmake).
if(NOT PELAGIC_DEBIAN)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
endif()

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME tools)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/presets DESTINATION ${CMAKE_INSTALL_DATADIR}/pelagic)
if(PELAGIC_TOOLS)
  install(TARGETS pelagic)
  if(PELAGIC_IMAGES AND NOT WIN32)
    install(TARGETS pelagic_images pelagic_exr LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/pelagic)
  endif()
  if(TARGET pelagic_manual_files)
    if(NOT PELAGIC_DEBIAN)
      install(FILES ${PROJECT_BINARY_DIR}/manual/pelagic.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
    endif()
    install(FILES ${PROJECT_SOURCE_DIR}/tools/manual/completion.bash RENAME pelagic
            DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  endif()
endif()

# The API reference of the installed headers, by Doxygen: the target `docs`.
find_program(PELAGIC_DOXYGEN doxygen)
if(PELAGIC_DOXYGEN AND NOT TARGET docs)
  set(reference_folder ${PROJECT_BINARY_DIR}/reference)
  list(JOIN installed_headers " " reference_headers)
  string(APPEND reference_headers " ${PROJECT_SOURCE_DIR}/capi/pelagic.h ${PROJECT_SOURCE_DIR}/cmake/reference.md")
  configure_file(cmake/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
  add_custom_target(docs COMMAND ${CMAKE_COMMAND} -E rm -rf ${reference_folder}
                    COMMAND ${CMAKE_COMMAND} -E make_directory ${reference_folder}
                    COMMAND ${PELAGIC_DOXYGEN} ${PROJECT_BINARY_DIR}/Doxyfile VERBATIM)
endif()
