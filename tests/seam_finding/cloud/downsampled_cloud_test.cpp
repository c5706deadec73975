#include "services/seam_finding/cloud/downsampled_cloud.hpp"

#include <catch2/catch.hpp>
#include <numeric>

using namespace arcstart;
using namespace arcstart::seam_finding;

namespace {

constexpr double kStep = 0.4;  // between points of a stripe; mm

// Appends a segment of so many points in a row along y, in the stripe that is not ended yet.
void add_segment(ScanCloud& cloud, int segment, int count, double from_y) {
  const int stripe = static_cast<int>(cloud.stripes.size());
  for (int i = 0; i < count; ++i) {
    cloud.points.emplace_back(4 * stripe, from_y + kStep * i, 0);
    cloud.origins.push_back({stripe, segment, i == 0 || i + 1 == count, 0, 0});
  }
}

std::vector<int> range(int from, int to) {
  std::vector<int> all(static_cast<std::size_t>(to - from));
  std::iota(all.begin(), all.end(), from);
  return all;
}

std::vector<int> joined(std::vector<int> one, const std::vector<int>& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

}  // namespace

TEST_CASE("of a segment are left its ends, marked ends, and points 1.5 mm apart") {
  ScanCloud cloud;
  add_segment(cloud, 0, 23, 0);
  add_segment(cloud, 1, 3, 9);  // begins 0.2 mm behind the first one's end
  end_stripe(cloud, ScanStripe::Seen::kSeen, {1, 2, 3}, {4, 5, 6});
  end_stripe(cloud, ScanStripe::Seen::kMissing);
  add_segment(cloud, 0, 11, 0);
  cloud.origins[26 + 6].segment_end = true;
  end_stripe(cloud, ScanStripe::Seen::kSeen);

  DownsampledCloud downsampled;
  downsample(cloud, downsampled);
  // Four steps are the first way of 1.5 mm or more.
  CHECK(downsampled.places == std::vector<int>{0, 4, 8, 12, 16, 20, 22, 23, 25,  // two segments
                                               26, 30, 32, 36});                 // 32 is marked
  REQUIRE(downsampled.cloud.size() == 13);
  for (int i = 0; i < 13; ++i) {
    CHECK(downsampled.cloud.points[i] == cloud.points[downsampled.places[i]]);
    CHECK(downsampled.cloud.origins[i].stripe == cloud.origins[downsampled.places[i]].stripe);
    CHECK(downsampled.cloud.origins[i].segment == cloud.origins[downsampled.places[i]].segment);
  }
  REQUIRE(downsampled.cloud.stripes.size() == 3);
  CHECK(downsampled.cloud.stripes[0].count == 9);
  CHECK(downsampled.cloud.stripes[0].camera_centre == Eigen::Vector3d(1, 2, 3));
  CHECK(downsampled.cloud.stripes[0].tool_position == Eigen::Vector3d(4, 5, 6));
  CHECK(downsampled.cloud.stripes[1].seen == ScanStripe::Seen::kMissing);
  CHECK(downsampled.cloud.stripes[2].first == 9);
  CHECK(downsampled.cloud.stripes[2].count == 4);
  CHECK(downsampled.is_less_than(cloud));
}

TEST_CASE("a scan is thinned stripe by stripe as it is at once") {
  ScanCloud cloud;
  DownsampledCloud growing, at_once;
  for (int stripe = 0; stripe < 5; ++stripe) {
    add_segment(cloud, 0, 20 + 7 * stripe, stripe);
    end_stripe(cloud, ScanStripe::Seen::kSeen);
    downsample(cloud, growing);
    downsample(cloud, growing);  // nothing new
  }
  downsample(cloud, at_once);
  CHECK(growing.places == at_once.places);
  CHECK(growing.cloud.stripes.size() == 5);
}

TEST_CASE(
    "what is thin already is not worth it, and of a cloud without stripes nothing is thinned") {
  ScanCloud sparse;
  for (int i = 0; i < 30; ++i) {
    sparse.points.emplace_back(0, 2 * i, 0);
    sparse.origins.push_back({0, 0, false, 0, 0});
  }
  end_stripe(sparse, ScanStripe::Seen::kSeen);
  DownsampledCloud all, none;
  downsample(sparse, all);
  CHECK(all.places == range(0, 30));
  CHECK_FALSE(all.is_less_than(sparse));
  const ScanCloud loose = unorganised_cloud(sparse.points);
  downsample(loose, none);
  CHECK(none.places.empty());
  CHECK_FALSE(none.is_less_than(loose));
}

TEST_CASE("a face of the thinned points is told in all points of the scan") {
  // A plate in z = 0 up to point 50 of the first segment, then something 5 mm higher; the second
  // segment lies as high as the plate and is not of the face; in the second stripe all is plate.
  ScanCloud cloud;
  add_segment(cloud, 0, 101, 0);
  add_segment(cloud, 1, 21, 60);
  end_stripe(cloud, ScanStripe::Seen::kSeen);
  add_segment(cloud, 0, 41, 0);
  end_stripe(cloud, ScanStripe::Seen::kSeen);
  for (int i = 51; i < 101; ++i) cloud.points[i].z() = 5;
  cloud.points[21].z() = 3;  // a stray
  DownsampledCloud downsampled;
  downsample(cloud, downsampled);
  std::vector<int> face;
  for (int i = 0; i < downsampled.cloud.size(); ++i)
    if (downsampled.cloud.points[i].z() == 0 && downsampled.cloud.origins[i].segment == 0)
      face.push_back(i);

  const Plane plate{Eigen::Vector3d::UnitZ(), 0};
  const std::vector<int> truth =
      joined(joined(range(0, 21), range(22, 51)), range(101 + 21, 101 + 21 + 41));
  CHECK(upsampled(cloud, downsampled, face, plate, 0.5) == truth);

  // A downsampled point of the face stays in it, whatever its distance from the plane.
  const Plane lower{Eigen::Vector3d::UnitZ(), 1};
  std::vector<int> own;
  for (const int i : face) own.push_back(downsampled.places[i]);
  CHECK(upsampled(cloud, downsampled, face, lower, 0.5) == own);
}
