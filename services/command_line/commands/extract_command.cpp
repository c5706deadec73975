#include "services/command_line/commands/extract_command.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/configuration.hpp"
#include "common/options.hpp"
#include "services/command_line/output/terminal.hpp"
#include "services/extraction/files/image_file.hpp"
#include "services/extraction/files/stripe_picture.hpp"
#include "services/extraction/image/laser_light.hpp"
#include "services/extraction/stripe_extractor.hpp"

namespace arcstart::command_line {
namespace {

namespace fs = std::filesystem;

struct ExtractOptions {
  std::vector<std::string> images;
  std::string csv, off, channel, picture, cell;
  bool all = false, as_found = false;
  double sigma_px = -1;  // below 0: not given
};

// Files as given, folders as the images in them, sorted by name.
std::vector<std::string> image_files(const std::vector<std::string>& paths) {
  const std::set<std::string> endings{".png", ".jpg",  ".jpeg", ".bmp",
                                      ".tif", ".tiff", ".pgm",  ".ppm"};
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    std::vector<std::string> inside;
    for (const auto& entry : fs::directory_iterator(path)) {
      std::string ending = entry.path().extension().string();
      std::transform(ending.begin(), ending.end(), ending.begin(),
                     [](unsigned char c) { return std::tolower(c); });
      if (entry.is_regular_file() && endings.count(ending) > 0)
        inside.push_back(entry.path().string());
    }
    if (inside.empty()) throw extraction::ImageFileError(path + ": a folder without images");
    std::sort(inside.begin(), inside.end());
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

cv::Mat read(const ExtractOptions& options, const std::string& path) {
  cv::Mat grey = extraction::read_grey_image(path, options.channel);
  if (options.off.empty()) return grey;
  const cv::Mat off = extraction::read_grey_image(options.off, options.channel);
  if (off.size() != grey.size())
    throw extraction::ImageFileError(fmt::format("{}: {} x {} pixels, {} has {} x {}", options.off,
                                                 off.cols, off.rows, path, grey.cols, grey.rows));
  const auto view = [](const cv::Mat& mat) {
    return extraction::GreyImage{mat.data, mat.cols, mat.rows,
                                 static_cast<std::ptrdiff_t>(mat.step)};
  };
  std::vector<std::uint8_t> light;
  extraction::laser_light(view(grey), view(off), light);
  return cv::Mat(light, true).reshape(1, grey.rows);
}

void write_centres(std::ostream& out, const ExtractOptions& options, const std::string& image,
                   const extraction::Stripe& stripe) {
  for (const extraction::StripeCentre& c : stripe.centres) {
    if (!c.chosen && !options.all) continue;
    out << image
        << fmt::format("{:.4f},{:.4f},{:.3f},{:.3f},{},{:.4f}", c.u, c.v, c.strength, c.width,
                       c.segment, c.deviation)
        << (options.all ? (c.chosen ? ",0\n" : ",1\n") : "\n");
  }
}

// OUT.png for one image, OUT_NAME.png for the image NAME of several.
std::string picture_path(const ExtractOptions& options, const std::string& image, bool several) {
  if (!several) return options.picture;
  fs::path path(options.picture);
  const std::string name =
      path.stem().string() + "_" + fs::path(image).stem().string() + path.extension().string();
  return path.replace_filename(name).string();
}

void write_picture(const ExtractOptions& options, const std::string& path, const cv::Mat& grey,
                   const extraction::Stripe& stripe) {
  std::vector<extraction::PictureCentre> centres;
  for (const extraction::StripeCentre& c : stripe.centres)
    if (c.chosen || options.all) centres.push_back({c.u, c.v, c.segment, c.chosen});
  bool written = false;
  try {
    written = cv::imwrite(path, extraction::draw_stripe(grey, centres));
  } catch (const cv::Exception&) {
  }
  if (!written)
    throw std::runtime_error(path + ": the picture cannot be written; it must end in .png");
}

void report(const std::string& path, const extraction::Stripe& stripe) {
  int chosen = 0, segments = 0, seconds = 0;
  for (const extraction::StripeCentre& c : stripe.centres) {
    if (!c.chosen)
      ++seconds;
    else {
      ++chosen;
      segments = c.segment + 1;
    }
  }
  if (chosen == 0)
    std::cerr << fmt::format("{}: {}\n", path,
                             stripe.empty.empty() ? "no stripe found" : stripe.empty);
  else
    std::cerr << fmt::format(
        "{}: {} centres in {} segments, {} second candidates; sigma {:.2f} px, noise {:.2f}, "
        "{:.0f} % saturated\n",
        path, chosen, segments, seconds, stripe.sigma, stripe.noise, 100 * stripe.saturated_share);
}

int run(const ExtractOptions& options) {
  const auto complain = [](const std::exception& error) {
    std::cerr << "extract: " << error.what() << "\n";
    return 2;
  };
  extraction::ExtractionSettings settings;
  if (!options.cell.empty())
    settings =
        Configuration::from_file(options.cell).read<extraction::ExtractionSettings>("extraction");
  if (options.sigma_px >= 0) settings.sigma_px = options.sigma_px;
  if (options.as_found) settings.smooth_course = false;

  std::vector<std::string> files;
  std::ofstream csv;
  try {
    files = image_files(options.images);
    if (!options.csv.empty()) {
      csv.open(options.csv);
      if (!csv) throw std::runtime_error(options.csv + ": cannot be written");
    }
  } catch (const std::exception& error) {
    return complain(error);
  }
  std::ostream& out = options.csv.empty() ? std::cout : csv;
  const bool several = files.size() > 1;
  ProgressLine progress;
  extraction::StripeExtractor extractor(settings);
  int exit_code = 1;
  bool headed = false;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (several) progress.show(fmt::format("extract: image {} of {}", i + 1, files.size()));
    try {
      const cv::Mat grey = read(options, files[i]);
      extractor.restart();  // each image stands alone
      const extraction::Stripe stripe = extractor.extract(
          {grey.data, grey.cols, grey.rows, static_cast<std::ptrdiff_t>(grey.step)});
      if (!headed)  // after the first image: bad input prints none
        out << (several ? "image," : "") << "u,v,strength,width,segment,sd"
            << (options.all ? ",rank\n" : "\n");
      headed = true;
      write_centres(out, options, several ? files[i] + "," : "", stripe);
      if (!options.picture.empty())
        write_picture(options, picture_path(options, files[i], several), grey, stripe);
      progress.clear();
      report(files[i], stripe);
      const bool found = std::any_of(stripe.centres.begin(), stripe.centres.end(),
                                     [](const auto& c) { return c.chosen; });
      if (found && exit_code == 1) exit_code = 0;
    } catch (const std::exception& error) {
      progress.clear();
      exit_code = complain(error);
    }
  }
  out.flush();
  if (!out) {
    std::cerr << "extract: the centres could not all be written\n";
    exit_code = 2;
  }
  return exit_code;
}

}  // namespace

void add_extract_command(CLI::App& parent, int& exit_code) {
  auto options = std::make_shared<ExtractOptions>();
  Command command(
      parent, "extract",
      "Find the laser stripe's centres in images: CSV of u,v,strength,width,segment,sd");
  command
      .option("images", options->images,
              "Images, or folders of images: PNG, JPEG, BMP, TIFF or PGM, 8 bit")
      .required()
      .existing_path();
  command.option("--csv", options->csv,
                 "File for the centres; without it they go to standard output");
  command.flag(
      "--all", options->all,
      "Second candidates (reflections and the like) too, with a column rank: 0 chosen, 1 second");
  command.flag("--as-found", options->as_found,
               "Each centre where its own pixel's neighbourhood says, not fitted along the "
               "stripe");
  command
      .option("--off", options->off,
              "The same view with the laser off, to be subtracted; clipping is judged before")
      .existing_file();
  command
      .option("--channel", options->channel,
              "Colour channel of the laser; needed for true colour alone")
      .one_of({"r", "g", "b"});
  command.option(
      "--picture", options->picture,
      "PNG to draw the centres into, over the image, coloured by segment; for several images NAME "
      "is added: OUT_NAME.png");
  command
      .option("--sigma", options->sigma_px,
              "Of the Gaussian kernels, px; 0: from the stripe's width in each image (the default)")
      .check([](const std::string& text) -> std::string {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        const bool number = !text.empty() && *end == 0;
        return number && (value == 0 || (value >= 0.8 && value <= 12))
                   ? ""
                   : "must be 0 or lie between 0.8 and 12";
      });
  command
      .option("--cell", options->cell,
              "The cell's file, cell.yaml, of which the section extraction is used")
      .existing_file();
  command.footer(
      "Columns: u to the right and v down in px, pixel centres at integers, the lens' distortion "
      "as seen; strength in grey "
      "values;\nwidth, the standard deviation of the stripe's profile, px; sd, the standard "
      "deviation of the centre, px.\n"
      "Several images get a first column, image. Exit: 0 stripe found (in one of several at "
      "least); 1 none found; 2 bad input.");
  command.run([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace arcstart::command_line
