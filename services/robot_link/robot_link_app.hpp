// The robot's questions on the bus: a scan for each, and its answer back to the controller.
#pragma once

#include <arcstart/delivery_t.hpp>
#include <arcstart/scan_t.hpp>
#include <map>
#include <optional>

#include "common/service.hpp"
#include "services/robot_link/controller_talk.hpp"
#include "services/robot_link/delivery/seam_delivery.hpp"
#include "services/robot_link/robot_link_settings.hpp"

namespace arcstart::robot_link {

class RobotLinkApp : public App {
 public:
  // The bus outlives the app.
  RobotLinkApp(Bus& bus, const RobotLinkSettings& settings, const Instance& instance,
               std::int64_t run_id, std::unique_ptr<ControllerLink> link);

  void tick(std::int64_t now_utime) override;
  Health health() const override;

 private:
  void on_scan(const scan_t& scan);
  void on_seam(const seam_t& seam);
  void serve(const Question& question, std::int64_t now_utime);
  void refuse(const Question& question, std::int32_t number, const std::string& why);
  std::string job_name(std::int32_t number) const;  // empty for none
  std::string not_ready() const;                    // why no scan can be made; empty where one can
  delivery_t delivery(std::int64_t now_utime) const;

  Bus& bus_;
  RobotLinkSettings settings_;
  Instance instance_;
  std::int64_t run_id_;
  DeliveryLimits limits_;
  mutable ControllerTalk talk_;

  Question question_;                // the one that is served
  std::int64_t question_since_ = 0;  // us, steady
  std::int64_t command_id_ = 0, next_send_ = 0;
  std::int64_t scan_ended_since_ = 0;  // us, steady; 0: it has not
  std::int64_t scan_id_ = 0;           // of the answer
  std::string reason_;
  Positions positions_{};
  std::int64_t delivered_utime_ = 0;

  struct Heard {
    std::int64_t steady;
    std::int8_t state;
  };
  std::map<std::string, Heard> services_;
  delivery_t told_{};
};

// The whole main of arcstart-robot-link.
int run(int argc, char** argv);

}  // namespace arcstart::robot_link
