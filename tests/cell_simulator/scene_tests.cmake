arcstart_test(cell_scene_test
  SOURCES mesh_test.cpp stl_test.cpp sensor_camera_test.cpp laser_fan_test.cpp scene_test.cpp joints_test.cpp scene_settings_test.cpp
          sensor_noise_test.cpp arc_light_test.cpp stripe_image_test.cpp ghost_and_shadow_test.cpp
  LINK arcstart::cell_scene arcstart::sensor_model opencv_core opencv_calib3d)

# Not a test: pictures for a person to look at, and the time a frame takes.
add_executable(render_scene render_scene.cpp)
target_link_libraries(render_scene PRIVATE arcstart::cell_scene opencv_core opencv_imgcodecs opencv_imgproc
                      arcstart_warnings)
set_target_properties(render_scene PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests/bin)
