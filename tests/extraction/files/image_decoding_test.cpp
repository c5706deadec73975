#include "services/extraction/files/image_decoding.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "services/extraction/files/image_file.hpp"
#include "tests/extraction/support/stripe_image.hpp"

using namespace arcstart;
using namespace arcstart::extraction;

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes png_of(const cv::Mat& image) {
  Bytes bytes;
  cv::imencode(".png", image, bytes);
  return bytes;
}

std::string decode(const Bytes& bytes, int width, int height) {
  cv::Mat image;
  const std::string error = decode_grey_png(bytes.data(), bytes.size(), width, height, image);
  // Whatever the bytes: either a reason, or exactly the image announced.
  if (error.empty()) {
    REQUIRE(image.type() == CV_8UC1);
    REQUIRE(image.size() == cv::Size(width, height));
  }
  return error;
}

cv::Mat some_image() {
  cv::Mat light = darkness(90, 60);
  add_stripe(light, -5, 20, 100, 40, 150, 2);
  return expose(light, 2);
}

// A folder of its own that goes away.
struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("arcstart-" + std::to_string(getpid()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string write(const std::string& name, const Bytes& bytes) const {
    std::ofstream(path / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    return (path / name).string();
  }
};

}  // namespace

TEST_CASE("a grey PNG gives its grey values") {
  const cv::Mat image = some_image();
  const Bytes bytes = png_of(image);
  cv::Mat decoded;
  REQUIRE(decode_grey_png(bytes.data(), bytes.size(), 90, 60, decoded) == "");
  CHECK(cv::norm(decoded, image, cv::NORM_INF) == 0);
}

TEST_CASE("a PNG that is not what it should be is refused with its reason") {
  const cv::Mat image = some_image();
  CHECK(decode(png_of(image), 91, 60) == "PNG is 90 x 60, announced were 91 x 60");
  cv::Mat colour(60, 90, CV_8UC3, cv::Scalar(1, 2, 3)), deep(60, 90, CV_16U, cv::Scalar(999));
  CHECK(decode(png_of(colour), 90, 60) == "PNG is not 8-bit grey");
  CHECK(decode(png_of(deep), 90, 60) == "PNG is not 8-bit grey");
  CHECK(decode({}, 90, 60) == "not a PNG");
  CHECK(decode({1, 2, 3}, 90, 60) == "not a PNG");
  Bytes jpeg;
  cv::imencode(".jpg", image, jpeg);
  CHECK(decode(jpeg, 90, 60) == "not a PNG");
}

TEST_CASE("a header that promises a huge image costs nothing") {
  Bytes bytes = png_of(some_image());
  for (int i = 16; i < 24; ++i) bytes[i] = 0x7f;
  CHECK(decode(bytes, 90, 60).find("announced were 90 x 60") != std::string::npos);
}

TEST_CASE("a PNG cut anywhere is refused") {
  const Bytes whole = png_of(some_image());
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    const std::string error =
        decode(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)), 90, 60);
    REQUIRE((error == "not a PNG" || error == "PNG is cut short"));
  }
  // With an end put on again.
  Bytes mended(whole.begin(), whole.begin() + 2000);
  mended.insert(mended.end(), whole.end() - 12, whole.end());
  CHECK_FALSE(decode(mended, 90, 60).empty());
}

TEST_CASE("random damage to a PNG, and random bytes, never do more than fail") {
  const Bytes whole = png_of(some_image());
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    Bytes bytes = whole;
    for (int k = 0; k < 1 + i % 5; ++k)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    refused += !decode(bytes, 90, 60).empty();
  }
  CHECK(refused > 350);  // a checksum covers nearly every byte
  for (int i = 0; i < 200; ++i) {
    Bytes bytes(whole.begin(), whole.begin() + 33);  // a sound header
    for (int k = 0; k < 300; ++k) bytes.push_back(static_cast<std::uint8_t>(random()));
    CHECK_FALSE(decode(bytes, 90, 60).empty());
  }
}

TEST_CASE("image files: grey stored as colour is grey, true colour needs its channel") {
  const Folder folder;
  const cv::Mat grey = some_image();
  cv::Mat as_colour, colour;
  cv::merge(std::vector<cv::Mat>{grey, grey, grey}, as_colour);
  cv::merge(std::vector<cv::Mat>{cv::Mat(grey * 0.2), cv::Mat(grey * 0.5), grey},
            colour);  // blue, green, red
  CHECK(cv::norm(read_grey_image(folder.write("g.png", png_of(grey))), grey, cv::NORM_INF) == 0);
  CHECK(cv::norm(read_grey_image(folder.write("c.png", png_of(as_colour))), grey, cv::NORM_INF) ==
        0);
  const std::string path = folder.write("true.png", png_of(colour));
  CHECK_THROWS_WITH(read_grey_image(path), Catch::Contains("--channel"));
  CHECK(cv::norm(read_grey_image(path, "r"), grey, cv::NORM_INF) == 0);
  CHECK(cv::norm(read_grey_image(path, "b"), grey * 0.2, cv::NORM_INF) == 0);
  CHECK(cv::norm(read_luminance((folder.path / "c.png").string()), grey, cv::NORM_INF) == 0);
  // 0.114 blue + 0.587 green + 0.299 red, ITU-R BT.601.
  CHECK(cv::norm(read_luminance(path), grey * 0.6153, cv::NORM_INF) <= 1);
}

TEST_CASE("image files that are none, or too deep, or too large, are refused in one line") {
  const Folder folder;
  const auto refusal = [](const std::string& path) -> std::string {
    try {
      read_grey_image(path);
    } catch (const ImageFileError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(refusal((folder.path / "absent.png").string()).find("No such file") != std::string::npos);
  CHECK(refusal(folder.write("empty.png", {})).find("not an image") != std::string::npos);
  CHECK(refusal(folder.write("text.png", {'a', 'b', 'c'})).find("not an image") !=
        std::string::npos);
  CHECK(refusal(folder.write("deep.png", png_of(cv::Mat(20, 20, CV_16U, cv::Scalar(7)))))
            .find("8 bit") != std::string::npos);
  Bytes huge = png_of(some_image());
  huge[18] = 0x4e, huge[19] = 0x20, huge[22] = 0x4e, huge[23] = 0x20;  // 20000 x 20000
  CHECK(refusal(folder.write("huge.png", huge)).find("20000 x 20000") != std::string::npos);
  const Bytes whole = png_of(some_image());
  CHECK(refusal(folder.write("cut.png", Bytes(whole.begin(), whole.begin() + 900)))
            .find("cut short") != std::string::npos);
  CHECK_FALSE(refusal(folder.path.string()).empty());
}
