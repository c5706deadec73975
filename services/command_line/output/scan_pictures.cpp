#include "services/command_line/output/scan_pictures.hpp"

#include <fmt/core.h>

#include <opencv2/imgcodecs.hpp>
#include <set>
#include <stdexcept>

#include "services/command_line/clouds/cloud_picture.hpp"
#include "services/command_line/clouds/point_cloud_file.hpp"
#include "services/command_line/output/contradiction_picture.hpp"
#include "services/extraction/files/stripe_picture.hpp"
#include "services/seam_finding/answer/wording.hpp"
#include "services/seam_finding/find_seam.hpp"
#include "services/seam_finding/scan/scan_answer.hpp"

namespace arcstart::command_line {
namespace {

constexpr Colour kGrey{150, 150, 150}, kYellow{190, 160, 40}, kBlue{60, 120, 255},
    kGreen{60, 200, 90}, kRed{255, 40, 40};
constexpr double kSeamStep = 0.25;  // between the points that show the seam in a cloud file; mm

int chosen_segments(const stripe_t& stripe) {
  std::set<int> segments;
  for (int i = 0; i < stripe.count; ++i)
    if (stripe.rank[i] == stripe_t::CHOSEN) segments.insert(stripe.segment[i]);
  return static_cast<int>(segments.size());
}

cv::Mat grey_of(const image_t& image) {
  if (image.encoding == image_t::PNG) return cv::imdecode(image.data, cv::IMREAD_GRAYSCALE);
  // No stripe comes of other encodings: they are not read yet.
  if (image.encoding != image_t::MONO8) return cv::Mat::zeros(image.height, image.width, CV_8U);
  cv::Mat grey(image.height, image.width, CV_8U);
  std::copy(image.data.begin(), image.data.end(), grey.data);
  return grey;
}

}  // namespace

ScanPictures::ScanPictures(const std::string& folder,
                           const seam_finding::SeamFindingSettings& settings)
    : folder_(folder), settings_(settings) {}

void ScanPictures::listen(Bus& bus, const std::string& sensor) {
  bus.subscribe<scan_t>(sensor + "_SCAN", Queue::measurements(), [this](const scan_t& state) {
    collector_.take(state);
    collect();
  });
  bus.subscribe<profile_t>(sensor + "_PROFILE", Queue::measurements(),
                           [this](const profile_t& profile) {
                             collector_.take(profile);
                             collect();
                           });
  bus.subscribe<seam_t>(sensor + "_SEAM", Queue::measurements(), [this](const seam_t& answer) {
    answer_ = answer;
    keep_contradicted();
  });
  bus.subscribe<image_t>(sensor + "_IMAGE", Queue::images(),
                         [this](const image_t& image) { image_ = image; });
  bus.subscribe<stripe_t>(sensor + "_STRIPE", Queue::measurements(),
                          [this](const stripe_t& stripe) { take(stripe); });
}

void ScanPictures::collect() {
  while (auto scan = collector_.next()) {
    const auto kept = std::make_shared<const seam_finding::CollectedScan>(std::move(*scan));
    if (kept->state.kind != scan_t::BACKGROUND)
      workpiece_ = kept;
    else if (seam_finding::background_error(*kept, settings_).empty())
      backgrounds_[kept->state.scan_id] = kept;
    keep_contradicted();
  }
}

// Once its scan and its answer are there, whichever comes first.
void ScanPictures::keep_contradicted() {
  if (!workpiece_ || workpiece_->state.scan_id != answer_.scan_id) return;
  if (!may_be_contradicted(answer_)) return;
  if (!contradicted_.empty() && contradicted_.back().work == workpiece_) return;
  const auto background = backgrounds_.find(answer_.background_scan_id);
  if (background != backgrounds_.end()) contradicted_.push_back({workpiece_, background->second});
}

void ScanPictures::take(const stripe_t& stripe) {
  if (stripe.seq != image_.seq || stripe.run_id != image_.run_id) return;
  const bool new_scan = stripe.scan_id != richest_.scan_id;
  if (!new_scan && chosen_segments(stripe) <= chosen_segments(richest_)) return;
  richest_ = stripe;
  richest_image_ = image_;
}

std::string ScanPictures::write() const {
  if (!workpiece_) throw std::runtime_error("no workpiece scan to draw");
  write_cloud();
  const int contradictions = write_contradictions();
  const bool images = richest_.count > 0;
  if (images) write_stripe();
  std::string written = "cloud.pcd, cloud.ply, cloud.png";
  if (images) written += ", stripe.png";
  if (contradictions > 0)
    written += fmt::format(", contradiction_SCANID.png of {} scans", contradictions);
  return images ? written : written + "; no stripe.png, the recording holds no images";
}

// As it was answered, but for what the referee took away: that is in no message.
ExaminedSeam ScanPictures::examined_again(const seam_finding::CollectedScan& work,
                                          Scan background) const {
  const seam_finding::ScanCloud cloud = seam_finding::cloud_of(work);
  const seam_finding::NoBackground nothing;
  std::optional<seam_finding::StoredBackground> stored;
  if (background) stored.emplace(*background, settings_);
  const seam_finding::SeamResult found = seam_finding::find_seam(
      cloud, stored ? stored->model() : static_cast<const seam_finding::Background&>(nothing),
      settings_, static_cast<std::uint64_t>(work.state.scan_id));
  // The paper's rules have no referee.
  if (settings_.start_rule != seam_finding::StartRule::kEdges) return {found, found, {}, {}};
  return examined(cloud, found);
}

int ScanPictures::write_contradictions() const {
  int count = 0;
  for (const Contradicted& scan : contradicted_) {
    const ExaminedSeam seam = examined_again(*scan.work, scan.background);
    if (seam.objections.empty()) continue;
    ContradictionPicture(seam).write(
        fmt::format("{}/contradiction_{}.png", folder_, scan.work->state.scan_id));
    ++count;
  }
  return count;
}

void ScanPictures::write_cloud() const {
  const seam_finding::ScanCloud cloud = seam_finding::cloud_of(*workpiece_);
  const Scan background = backgrounds_.empty() ? nullptr : backgrounds_.rbegin()->second;
  const ExaminedSeam seam = examined_again(*workpiece_, background);
  const seam_finding::SeamResult& result = seam.found;
  std::vector<Colour> colours(cloud.points.size(), kYellow);
  for (const int i : result.background) colours[static_cast<std::size_t>(i)] = kGrey;
  for (const int i : result.plates[0]) colours[static_cast<std::size_t>(i)] = kBlue;
  for (const int i : result.plates[1]) colours[static_cast<std::size_t>(i)] = kGreen;

  CloudPicture picture;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Colour& colour = colours[i];
    auto& points = colour == kGrey    ? picture.background
                   : colour == kBlue  ? picture.plates[0]
                   : colour == kGreen ? picture.plates[1]
                                      : picture.others;
    points.push_back(cloud.points[i]);
  }
  std::vector<Eigen::Vector3d> points = cloud.points;
  if (seam.ruled.verdict == seam_finding::SeamResult::Verdict::kFound) {
    picture.seam = {result.start, result.end};
    picture.title = "weld seam: " + result.joint_type;
    for (double along = 0; along < (result.end - result.start).norm(); along += kSeamStep) {
      points.push_back(result.start + along * result.direction);
      colours.push_back(kRed);
    }
  } else {
    picture.title = "no seam: " + in_words(seam.ruled.reason);
    if (result.verdict == seam_finding::SeamResult::Verdict::kFound)
      picture.alternatives.emplace_back(result.start, result.end);  // refused by the referee
  }
  for (const auto& other : result.alternatives)
    picture.alternatives.emplace_back(other.start, other.end);
  write_pcd(folder_ + "/cloud.pcd", points, colours);
  write_ply(folder_ + "/cloud.ply", points, colours);
  draw_cloud(picture, folder_ + "/cloud.png");
}

void ScanPictures::write_stripe() const {
  std::vector<extraction::PictureCentre> centres;
  for (int i = 0; i < richest_.count; ++i)
    centres.push_back({richest_.u[i] - richest_image_.offset_u,
                       richest_.v[i] - richest_image_.offset_v, richest_.segment[i],
                       richest_.rank[i] == stripe_t::CHOSEN});
  const cv::Mat grey = grey_of(richest_image_);
  if (grey.empty() || !cv::imwrite(folder_ + "/stripe.png", extraction::draw_stripe(grey, centres)))
    throw std::runtime_error(folder_ + "/stripe.png: cannot be written");
}

}  // namespace arcstart::command_line
