#include "tests/bench/seam/rendered_answer.hpp"

#include "services/extraction/extraction_app.hpp"
#include "services/reconstruction/reconstruction_app.hpp"
#include "services/seam_finding/seam_finding_app.hpp"

namespace arcstart {

RenderedAnswer answer_rendered(const SimulatedScanSettings& settings, const std::string& joint_type,
                               std::uint64_t seed) {
  const auto bus = Bus::in_memory();
  const Instance instance;  // no state folder: nothing outlives the run
  extraction::ExtractionApp extraction(*bus, extraction::ExtractionSettings{}, instance);
  reconstruction::ReconstructionApp reconstruction(*bus, reconstruction::ReconstructionSettings{},
                                                   instance);
  seam_finding::SeamFindingSettings seam_settings;
  seam_settings.joint_type = joint_type;
  seam_finding::SeamFindingApp seam_finding(*bus, seam_settings, instance);
  RenderedAnswer outcome{};
  outcome.seam.verdict = seam_t::REFUSED;
  outcome.seam.reason = "no answer came";
  bus->subscribe<seam_t>("LASER0_SEAM", Queue::measurements(),
                         [&](const seam_t& seam) { outcome.seam = seam; });
  // Losses spoil the workpiece scan alone: a background is scanned again until it is whole.
  SimulatedScanSettings whole = settings;
  whole.frames_lost_share = whole.positions_lost_share = 0;
  SimulatedScan scan(*bus, whole, seed);
  scan.run(cell_simulator::SceneKind::background);
  scan.set_losses(settings.frames_lost_share, settings.positions_lost_share);
  scan.run(cell_simulator::SceneKind::workpiece);
  outcome.truth = scan.truth();
  return outcome;
}

}  // namespace arcstart
