# The scene and the renderer of the simulated cell; no LCM, no clock.
arcstart_library(cell_scene
  SOURCES sensor_camera.cpp
  LINK arcstart::geometry arcstart::configuration)
