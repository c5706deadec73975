#include "tests/seam_finding/support/synthetic_messages.hpp"

namespace arcstart::seam_finding::synthetic {

ScanMessages to_messages(const ScanCloud& cloud, const ScanIdentity& identity) {
  ScanMessages messages;
  const int count = static_cast<int>(cloud.stripes.size());
  for (int k = 0; k < count; ++k) {
    const ScanStripe& stripe = cloud.stripes[k];
    profile_t profile{};
    profile.utime = identity.scan_id + 71'000 * (k + 1);
    profile.run_id = identity.run_id;
    profile.seq = identity.first_seq + k;
    profile.scan_id = identity.scan_id;
    profile.scan_index = k;
    profile.count = stripe.count;
    for (int i = stripe.first; i < stripe.first + stripe.count; ++i) {
      profile.x.push_back(static_cast<float>(cloud.points[i].x()));
      profile.y.push_back(static_cast<float>(cloud.points[i].y()));
      profile.z.push_back(static_cast<float>(cloud.points[i].z()));
      profile.u.push_back(0);
      profile.v.push_back(0);
      profile.deviation.push_back(cloud.origins[i].deviation);
      profile.segment.push_back(static_cast<std::int16_t>(cloud.origins[i].segment));
      profile.segment_end.push_back(cloud.origins[i].segment_end ? profile_t::EDGE
                                                                 : profile_t::CONTINUES);
    }
    for (int axis = 0; axis < 3; ++axis) {
      profile.tool_position[axis] = stripe.tool_position[axis];
      profile.camera_centre[axis] = stripe.camera_centre[axis];
    }
    profile.tool_quaternion[0] = 1;
    profile.calibration_id = identity.calibration_id;
    if (profile.count == 0) {
      profile.why = profile_t::NO_STRIPE;
      profile.empty = "stripe empty: no stripe found";
    }
    messages.profiles.push_back(profile);
  }
  scan_t& state = messages.scanning;
  state.utime = identity.scan_id;
  state.run_id = identity.run_id;
  state.state = scan_t::SCANNING;
  state.scan_id = state.begin_utime = identity.scan_id;
  state.kind = identity.kind;
  state.start_command_id = state.command_id = identity.scan_id % 1000 + 1;
  state.request = identity.request;
  state.job = identity.job;
  state.part = identity.part;
  state.clock_bound = 0;  // one clock
  state.first_seq = state.last_seq = -1;
  state.previous_first_seq = state.previous_last_seq = -1;
  messages.ended = state;
  messages.ended.state = scan_t::ENDED;
  messages.ended.end_utime = messages.ended.utime = identity.scan_id + 71'000 * (count + 2);
  messages.ended.first_seq = count > 0 ? identity.first_seq : -1;
  messages.ended.last_seq = count > 0 ? identity.first_seq + count - 1 : -1;
  messages.ended.images = count;
  messages.ended.end_cause = scan_t::STOP;
  messages.ended.end_reason = "stop";
  return messages;
}

scan_t idle_state(std::int64_t run_id) {
  scan_t state{};
  state.utime = state.run_id = run_id;
  state.state = scan_t::IDLE;
  state.clock_bound = 0;  // one clock
  state.first_seq = state.last_seq = -1;
  state.previous_first_seq = state.previous_last_seq = -1;
  return state;
}

}  // namespace arcstart::seam_finding::synthetic
