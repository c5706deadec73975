// Parts of bench_extraction. Each prints its table on standard output and adds its figures.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tests/extraction/support/steel_scene.hpp"

namespace arcstart {

// Rendered scenes with exact truth, seeds 1 to `seeds` of each: the extractor as the service runs
// it, beside the plain ridge detector and the usual one-centre-a-column methods.
void bench_accuracy(int seeds, nlohmann::json& json);

// Low contrast with one disturbance of the scene left out: which makes the error, at which sigma.
void bench_disturbances(int seeds, nlohmann::json& json);

// Straight parts under white noise alone, beside the law of centre_deviation.
void bench_white_noise(int seeds, nlohmann::json& json);

// The fast ridge detector's points beside those of the plain form in double precision.
void bench_identity(int seeds, nlohmann::json& json);

// Stripes of a real sensor, without truth: how straight the centres lie, and in how many rows.
void bench_real_images(nlohmann::json& json);

// Surfaces and surroundings of real steel, rendered with exact truth: in how many images the course
// is the stripe and nothing else, how far off, and how far off it claims to be.
void bench_steel(extraction::SteelSceneKind kind, int first_seed, int seeds, nlohmann::json& json);

// The middle of each scene of seed 1 with its centres, FOLDER/<scene>.jpg.
void draw_scenes(const std::string& folder);

// Time of this thread for a frame of 1600 x 1200, all methods by turns in one process, the least of
// `rounds`.
void bench_speed(int rounds, nlohmann::json& json);

}  // namespace arcstart
