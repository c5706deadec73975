arcstart_test(cell_simulator_arm_test
  SOURCES fanuc_m20ia_test.cpp hspo_packet_test.cpp robot_controller_test.cpp search_motion_test.cpp cell_faults_test.cpp
          calibration_writer_test.cpp
  LINK arcstart::cell_arm)
arcstart_test(cell_simulator_frame_renderer_test SOURCES frame_renderer_test.cpp LINK arcstart::cell_devices)
arcstart_test(cell_simulator_hspo_sender_test SOURCES hspo_sender_test.cpp LINK arcstart::cell_devices)

# The camera's control port is fixed, so these run in a network of their own; where none is to be had they are skipped,
# and fail under CI.
add_executable(cell_simulator_camera_test gige_camera_test.cpp camera_controller_test.cpp
               cell_simulator_app_test.cpp)
target_link_libraries(cell_simulator_camera_test PRIVATE arcstart::cell_simulator_app PkgConfig::aravis
                      arcstart_catch_main arcstart_warnings)
set_target_properties(cell_simulator_camera_test PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests/bin)
set(in_private_network ${PROJECT_SOURCE_DIR}/scripts/in-private-network)
add_test(NAME cell_simulator_camera_test
         COMMAND sh -c "${in_private_network} true || { [ -n \"$CI\" ] && exit 1; exit 77; }; \
exec ${in_private_network} $<TARGET_FILE:cell_simulator_camera_test>")
set_tests_properties(cell_simulator_camera_test PROPERTIES TIMEOUT 300 SKIP_RETURN_CODE 77)
