#include "services/sensor_capture/sensor_capture_app.hpp"
#include "services/sensor_capture/sources/aravis_source.hpp"
#include "services/sensor_capture/sources/folder_source.hpp"

namespace arcstart::sensor_capture {

int run(int argc, char** argv) {
  const ServiceDescription description{
      "sensor_capture", "takes frames from the camera, switches its laser and owns the scans"};
  return run_service(argc, argv, description, [](ServiceContext& context) {
    const auto settings = context.settings<SensorCaptureSettings>("sensor_capture");
    const auto notify = [&bus = context.bus] { bus.wake(); };
    std::unique_ptr<FrameSource> source;
    if (settings.source == "folder")
      source = std::make_unique<FolderSource>(settings, notify);
    else
      source = std::make_unique<AravisSource>(settings, notify);
    return std::make_unique<SensorCaptureApp>(context.bus, settings, context.instance,
                                              context.run_id, std::move(source));
  });
}

}  // namespace arcstart::sensor_capture
