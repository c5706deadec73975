// arcstart-seam-finding: profiles of a scan in, the weld seam and where it starts out.
#include <memory>
#include <utility>

#include "common/jobs/job_file.hpp"
#include "common/service.hpp"
#include "services/seam_finding/seam_finding_app.hpp"

namespace arcstart::seam_finding {

int run(int argc, char** argv) {
  const ServiceDescription description{"seam_finding",
                                       "finds the weld seam in a scan, and where it starts"};
  return run_service(argc, argv, description, [](ServiceContext& context) -> std::unique_ptr<App> {
    const auto settings = context.settings<SeamFindingSettings>("seam_finding");
    if (context.configuration.has("jobs")) context.settings<JobsSettings>("jobs");
    // STATUS, and so every recording, says what held for the newest scans.
    JobBook jobs(context.configuration, settings,
                 [&context, of_cell = context.effective_text](const std::string& section) {
                   context.effective_text = of_cell + section;
                 });
    return std::make_unique<SeamFindingApp>(context.bus, settings, context.instance,
                                            std::move(jobs));
  });
}

}  // namespace arcstart::seam_finding
