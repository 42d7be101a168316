include(CMakePackageConfigHelpers)

# plumescout_publish(client LIBRARIES core_types client HEADERS planner_client.h)
#
# Installs, as component `client`, the package `plumescout`: the libraries as plumescout::core_types
# and so on; those headers of the present folder; all of core/types; the wire, as .proto files, as
# generated headers and as the descriptors of the latest release. Headers lie below a root of their
# own, by the paths that they have in the repository: includes read the same in both places.
function(plumescout_publish component)
  cmake_parse_arguments(ARG "" "" "LIBRARIES;HEADERS" ${ARGN})
  set(include_root ${CMAKE_INSTALL_INCLUDEDIR}/plumescout)
  set(config_root ${CMAKE_INSTALL_LIBDIR}/cmake/plumescout)
  set(data_root ${CMAKE_INSTALL_DATADIR}/plumescout)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})

  foreach(library ${ARG_LIBRARIES})
    set(target plumescout_${library})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${library})
    target_compile_features(${target} PUBLIC cxx_std_20)
    install(TARGETS ${target} EXPORT plumescout COMPONENT ${component}
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} INCLUDES DESTINATION ${include_root})
  endforeach()
  install(EXPORT plumescout NAMESPACE plumescout:: FILE plumescoutTargets.cmake
          DESTINATION ${config_root} COMPONENT ${component})

  install(FILES ${ARG_HEADERS} DESTINATION ${include_root}/${folder} COMPONENT ${component})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/core/types DESTINATION ${include_root}/core
          COMPONENT ${component} FILES_MATCHING PATTERN *.h)
  install(DIRECTORY ${CMAKE_BINARY_DIR}/generated/plumescout/v1
          DESTINATION ${include_root}/plumescout COMPONENT ${component} FILES_MATCHING PATTERN *.h)
  install(DIRECTORY ${CMAKE_BINARY_DIR}/generated/google/rpc
          DESTINATION ${include_root}/google COMPONENT ${component} FILES_MATCHING PATTERN *.h)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/proto/plumescout ${PROJECT_SOURCE_DIR}/proto/google
          DESTINATION ${data_root}/proto COMPONENT ${component} FILES_MATCHING PATTERN *.proto)
  install(FILES ${PROJECT_SOURCE_DIR}/proto/released.binpb
          DESTINATION ${data_root}/proto COMPONENT ${component})
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE
          DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT ${component})

  configure_package_config_file(
    ${PROJECT_SOURCE_DIR}/cmake/plumescoutConfig.cmake.in
    ${CMAKE_BINARY_DIR}/plumescoutConfig.cmake INSTALL_DESTINATION ${config_root})
  write_basic_package_version_file(${CMAKE_BINARY_DIR}/plumescoutConfigVersion.cmake
                                   COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_BINARY_DIR}/plumescoutConfig.cmake
                ${CMAKE_BINARY_DIR}/plumescoutConfigVersion.cmake
          DESTINATION ${config_root} COMPONENT ${component})
endfunction()
