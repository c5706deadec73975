# The arm and its controller's bytes; no LCM, no clock.
arcstart_library(cell_arm
  SOURCES fanuc_m20ia.cpp hspo_packet.cpp robot_controller.cpp search_motion.cpp calibration_writer.cpp
  LINK arcstart::geometry arcstart::cell_scene arcstart::configuration PkgConfig::kdl)

# The devices on the network. The camera's features go into the program, so that it needs no file of its own.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS camera_features.xml)
file(READ camera_features.xml CAMERA_FEATURES)
file(CONFIGURE OUTPUT camera_features.hpp @ONLY CONTENT
  "// From camera_features.xml.\n#pragma once\ninline constexpr char kCameraFeatures[] = R\"xml(@CAMERA_FEATURES@)xml\";\n")
arcstart_library(cell_devices
  SOURCES frame_renderer.cpp camera_registers.cpp controller_watch.cpp gige_camera.cpp hspo_sender.cpp
  LINK arcstart::cell_scene arcstart::cell_arm arcstart::service PkgConfig::aravis)
target_include_directories(arcstart_cell_devices PRIVATE ${CMAKE_CURRENT_BINARY_DIR})

arcstart_library(cell_simulator_app
  SOURCES cell_simulator_app.cpp simulated_cell.cpp
  LINK arcstart::cell_devices arcstart::service)
arcstart_service(cell_simulator LINK arcstart::cell_simulator_app)
