// arcstart-extraction: camera images in, stripe centres out.
#include <memory>

#include "common/service.hpp"
#include "services/extraction/extraction_app.hpp"

namespace arcstart::extraction {

int run(int argc, char** argv) {
  const ServiceDescription description{"extraction",
                                       "finds the laser stripe's centres in each camera image"};
  return run_service(argc, argv, description, [](ServiceContext& context) -> std::unique_ptr<App> {
    return std::make_unique<ExtractionApp>(
        context.bus, context.settings<ExtractionSettings>("extraction"), context.instance);
  });
}

}  // namespace arcstart::extraction
