# What scripts/packages makes .deb packages of. It puts what a component has besides its programs
# (manuals, completions, pages, notices) in packages/COMPONENT of the build folder, by the paths that
# they have below /usr.
set(PLUMESCOUT_PACKAGED server robot client python)
if(PLUMESCOUT_BUILD_LAB)
  list(APPEND PLUMESCOUT_PACKAGED lab)
endif()
if(TARGET plumescout-ros2)
  list(APPEND PLUMESCOUT_PACKAGED ros2)
endif()
foreach(component ${PLUMESCOUT_PACKAGED})
  install(DIRECTORY ${CMAKE_BINARY_DIR}/packages/${component}/ DESTINATION .
          COMPONENT ${component} OPTIONAL USE_SOURCE_PERMISSIONS)
endforeach()
# What belongs to the machine, wherever programs are.
install(FILES ${PROJECT_SOURCE_DIR}/deploy/config/plumescout.yaml DESTINATION /etc/plumescout
        COMPONENT machine EXCLUDE_FROM_ALL)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME plumescout)
set(CPACK_PACKAGE_VENDOR PlumeScout)
set(CPACK_PACKAGE_CONTACT "PlumeScout contributors <plumescout@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL ${PLUMESCOUT_PACKAGED} machine)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# plumescout_package(server plumescout-server "one line" [DEPENDS "..."] [ARCHITECTURE all])
function(plumescout_package component name summary)
  cmake_parse_arguments(ARG "" "DEPENDS;ARCHITECTURE" "" ${ARGN})
  string(TOUPPER ${component} COMPONENT)
  set(CPACK_COMPONENT_${COMPONENT}_GROUP ${component} PARENT_SCOPE)
  set(CPACK_COMPONENT_GROUP_${COMPONENT}_DESCRIPTION "${summary}" PARENT_SCOPE)
  set(CPACK_COMPONENT_${COMPONENT}_DESCRIPTION "${summary}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME ${name} PARENT_SCOPE)
  foreach(field DEPENDS ARCHITECTURE)
    if(ARG_${field})
      set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_${field} "${ARG_${field}}" PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# The user that the server runs as comes about by systemd-sysusers, and its folder by systemd-tmpfiles; in
# containers by their small twins.
plumescout_package(server plumescout-server
  "planning service for robots that map gas leaks: gRPC server and web console"
  DEPENDS "systemd-standalone-sysusers | systemd, systemd-standalone-tmpfiles | systemd")
set(CPACK_COMPONENT_MACHINE_GROUP server)
set(CPACK_DEBIAN_SERVER_PACKAGE_CONTROL_EXTRA
    "${PROJECT_SOURCE_DIR}/deploy/debian/postinst;${PROJECT_SOURCE_DIR}/deploy/debian/prerm;${PROJECT_SOURCE_DIR}/deploy/debian/postrm;${PROJECT_SOURCE_DIR}/deploy/debian/conffiles")
plumescout_package(robot plumescout-robot
  "robot side of PlumeScout: sensors in, paths out, by lines of JSON")
plumescout_package(client libplumescout-client-dev
  "C++ client library of PlumeScout, and its wire format"
  DEPENDS "libabsl-dev, libgrpc++-dev, libprotobuf-dev, protobuf-compiler, protobuf-compiler-grpc, libssl-dev, libyaml-cpp-dev, libzstd-dev, zlib1g-dev")
plumescout_package(lab plumescout-lab
  "laboratory of PlumeScout: simulated robots and gas, replays, studies"
  DEPENDS "fonts-dejavu-core")
plumescout_package(python python3-plumescout
  "Python client of PlumeScout, and plumescoutctl"
  DEPENDS "python3 (>= 3.10), python3-grpcio, python3-numpy, python3-protobuf" ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/deploy/debian/python/prerm)
plumescout_package(ros2 plumescout-ros2
  "puts robots that speak ROS 2 into missions of PlumeScout, by DDS")
include(CPack)
