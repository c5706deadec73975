#include "services/calibration/report/calibration_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "services/calibration/report/report_charts.hpp"

namespace arcstart::calibration {
namespace {

constexpr const char* kStyle =
    "body{font:15px/1.5 sans-serif;max-width:1040px;margin:2em auto;padding:0 1em;color:#222}"
    "h1{font-size:1.5em}table{border-collapse:collapse}td,th{padding:.2em .8em;border-bottom:1px "
    "solid #ddd;text-align:left}figure{display:inline-block;margin:.5em .5em 1em "
    "0;vertical-align:top}figcaption{font-size:.85em}svg{background:#fafafa;border:1px solid "
    "#eee}text{font-size:10px;text-anchor:middle}.bar{fill:#4878a8}.bad{fill:#c03028}.limit{stroke:"
    "#c03028;stroke-dasharray:4}.frame{fill:none;stroke:#999}.arrow{stroke:#c03028}.passed{color:"
    "#187818}.failed,.refused{color:#c03028}";

std::string list(const std::string& heading, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text = "<h2>" + heading + "</h2><ul>";
  for (const std::string& line : lines) text += "<li>" + escaped(line) + "</li>";
  return text + "</ul>\n";
}

std::string row(const std::string& what, const std::string& value, const std::string& remark) {
  return fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>", what, value, remark);
}

std::string figures(const CalibrationRun& run, const CalibrationLimits& limits) {
  const Adjustment& a = run.adjustment;
  const double degree = 180 / std::numbers::pi;
  std::string text = "<h2>How good it is</h2><table>";
  if (run.has_laser) {
    text +=
        row("Laser points of poses it never saw (leave one out), RMS",
            fmt::format("<b>{:.3f} mm</b>", run.left_one_out.laser_rms_mm),
            fmt::format("median {:.3f}, 95 % below {:.3f}; Park and plain fits {:.3f}; limit {}",
                        run.left_one_out.laser_median_mm, run.left_one_out.laser_95_mm,
                        run.plain_left_one_out.laser_rms_mm, limits.leave_one_out_mm));
    double worst = 0;
    for (const PredictedError& error : run.field) worst = std::max(worst, error.axes_mm.norm());
    text += row(
        "Predicted deviation of a laser point in base, worst", fmt::format("{:.3f} mm", worst),
        fmt::format("robot and stripe taken as exact; limit {}", limits.predicted_deviation_mm));
    text += row("Laser plane, RMS of its points", fmt::format("{:.4f} mm", a.laser_rms),
                fmt::format("fitted apart {:.4f}; {}", run.laser_apart.rms_mm,
                            run.crossings == 0
                                ? std::string("the stripe crosses no line of the grid")
                                : fmt::format("{} crossings of stripe and grid differ by {:.4f}",
                                              run.crossings, run.crossing_rms_mm)));
  }
  text +=
      row("Plate's points carried to base, RMS", fmt::format("{:.3f} mm", run.hand_eye_residual_mm),
          "with the robot taken at its word");
  text += row("Camera, RMS of the reprojection", fmt::format("{:.3f} px", a.camera_rms),
              fmt::format("camera alone {:.3f}{}", run.camera.rms,
                          run.camera_held ? "; camera held, too few or too alike poses" : ""));
  text += row(
      "Robot's own deviation, per axis",
      fmt::format("{:.3f} mm, {:.4f} deg", a.deviations.robot_mm, a.deviations.robot_rad * degree),
      "estimated from the data");
  const auto sd = [&](int i) { return std::sqrt(std::max(0.0, a.covariance(i, i))); };
  text += row("Standard deviation of the hand-eye's position",
              fmt::format("{:.3f}, {:.3f}, {:.3f} mm", sd(15), sd(16), sd(17)),
              fmt::format("turn {:.4f}, {:.4f}, {:.4f} deg", sd(12) * degree, sd(13) * degree,
                          sd(14) * degree));
  text += row("Plate, highest less lowest point", fmt::format("{:.3f} mm", run.flatness.bend_mm),
              fmt::format("a height is known to {:.3f}", run.flatness.deviation_mm));
  for (const HandEyeMethod& method : run.methods)
    text +=
        row("Hand-eye by " + method.name + " alone",
            fmt::format("{:.3f} mm", method.consistency_mm), "consistency of the plate in base");
  return text + "</table>\n";
}

std::string charts(const Target& plate, const CalibrationRun& run,
                   const CalibrationLimits& limits) {
  const Adjustment& a = run.adjustment;
  std::vector<std::string> labels;
  std::vector<double> moved, turned;
  std::vector<Arrow> arrows;
  for (std::size_t i = 0; i < run.views.size(); ++i) {
    labels.push_back(std::to_string(run.views[i].index));
    moved.push_back(a.robot[i].translation.norm());
    turned.push_back(a.robot[i].rotation.norm() * 180 / std::numbers::pi);
    const auto residuals =
        reprojection(a.state.model, plate, a.state.T_camera_plate[i], run.views[i]);
    for (std::size_t k = 0; k < residuals.size(); ++k)
      arrows.push_back({run.views[i].target[k], residuals[k]});
  }
  std::string text = "<h2>Pose by pose</h2>\n";
  if (run.has_laser)
    text += bar_chart("Leave one out: laser points' distance, RMS", labels,
                      run.left_one_out.view_laser_rms_mm, limits.leave_one_out_mm, "mm");
  text += bar_chart("Where the robot was, from where it said", labels, moved, 0, "mm");
  text += bar_chart("How it was turned from what it said", labels, turned, 0, "deg");
  text += bar_chart("Reprojection, RMS", labels, a.pixel_rms, limits.camera_residual_px, "px");
  text += "<h2>Over the field</h2>\n";
  text += arrow_chart(
      "Residuals of the plate's points", a.state.model.width, a.state.model.height, arrows,
      std::max(1.0, std::round(a.state.model.width / 40 / std::max(1e-3, a.camera_rms))));
  std::vector<Spot> spots;
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const PredictedError& error : run.field) {
    spots.push_back({error.pixel, error.axes_mm.norm()});
    low = low.cwiseMin(error.pixel);
    high = high.cwiseMax(error.pixel);
  }
  text += spot_chart(
      fmt::format("Predicted deviation of a laser point, columns {:.0f} to {:.0f}, rows {:.0f} "
                  "to {:.0f}",
                  low.x(), high.x(), low.y(), high.y()),
      low, high, spots, "mm");
  spots.clear();
  low = {1e9, 1e9};
  high = {-1e9, -1e9};
  const auto points = plate.points();
  for (std::size_t k = 0; k < points.size() && k < run.flatness.height_mm.size(); ++k) {
    spots.push_back({points[k].head<2>(), run.flatness.height_mm[k]});
    low = low.cwiseMin(points[k].head<2>());
    high = high.cwiseMax(points[k].head<2>());
  }
  return text + spot_chart("Height of the plate's points", low, high, spots, "mm");
}

}  // namespace

std::string calibration_report(const std::string& title, const Target& plate,
                               const std::vector<View>& views, const CalibrationRun& run,
                               const CalibrationLimits& limits,
                               const std::vector<std::string>& missed, const std::string& forced_by,
                               const PoseImage& image) {
  const std::string verdict = !run.refused.empty() ? "refused"
                              : missed.empty()     ? "passed"
                                                   : "failed";
  std::string page = fmt::format(
      "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>{0}</title>"
      "<style>{1}</style><h1>{0}: <span class=\"{2}\">{2}</span></h1><p>{3} of {4} poses.</p>\n",
      escaped(title), kStyle, verdict, run.views.size(), views.size());
  if (!run.refused.empty()) page += "<p><b>" + escaped(run.refused) + "</b></p>\n";
  if (!forced_by.empty())
    page += "<p><b>Forced into use by " + escaped(forced_by) +
            ": no seam measured with it is usable.</b></p>\n";
  page += list("Limits missed", missed);
  std::vector<std::string> left_out;
  for (const LeftOutView& view : run.left_out)
    left_out.push_back(fmt::format("pose {}: {}", view.index, view.why));
  page += list("Left out", left_out) + list("Warnings", run.warnings) +
          list("What would improve it", run.advice);
  if (run.refused.empty()) page += figures(run, limits) + charts(plate, run, limits);
  page += "<h2>What was seen</h2>\n";
  for (const View& view : views) {
    const auto used = std::find_if(run.views.begin(), run.views.end(),
                                   [&](const View& v) { return v.index == view.index; });
    const bool is_used = used != run.views.end();
    const cv::Mat grey = image(view.index);
    if (!grey.empty())
      page += picture(fmt::format("Pose {}{}", view.index, is_used ? "" : ", left out"), grey,
                      view.target, is_used ? used->stripe : view.stripe);
  }
  return page + "</html>\n";
}

}  // namespace arcstart::calibration
