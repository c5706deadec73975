# The scene and the renderer of the simulated cell; no LCM, no clock.
arcstart_library(cell_scene
  SOURCES triangle_mesh.cpp triangle_hierarchy.cpp stl.cpp tool_shapes.cpp table.cpp work.cpp ball.cpp clutter.cpp scene.cpp
          sensor_camera.cpp laser_fan.cpp scene_view.cpp stripe_canvas.cpp sensor_noise.cpp arc_light.cpp image_renderer.cpp plate_images.cpp
          plate_view.cpp
  LINK arcstart::geometry arcstart::configuration)
