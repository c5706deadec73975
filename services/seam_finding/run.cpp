// arcstart-seam-finding: profiles of a scan in, the weld seam and where it starts out.
#include <memory>

#include "common/service.hpp"
#include "services/seam_finding/seam_finding_app.hpp"

namespace arcstart::seam_finding {

int run(int argc, char** argv) {
  const ServiceDescription description{"seam_finding",
                                       "finds the weld seam in a scan, and where it starts"};
  return run_service(argc, argv, description, [](ServiceContext& context) -> std::unique_ptr<App> {
    return std::make_unique<SeamFindingApp>(
        context.bus, context.settings<SeamFindingSettings>("seam_finding"), context.instance);
  });
}

}  // namespace arcstart::seam_finding
