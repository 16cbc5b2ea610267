#include <catch2/catch.hpp>
#include <fstream>

#include "framework/core/error.hpp"
#include "framework/core/record_file.hpp"
#include "framework/core/se3.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using Catch::Matchers::Contains;

namespace shapes {

struct Circle {
  std::string name;
  double radius = 0;
};
void save(RecordWriter& out, const Circle& circle) {
  out.add(circle.name);
  out.add(circle.radius);
}
void load(RecordReader& in, Circle& circle) {
  in.take(circle.name);
  in.take(circle.radius);
}

}  // namespace shapes

namespace {

constexpr std::string_view kMagic = "PPMTEST\n";

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A file with two records: a number, and a text.
void write_two(const std::filesystem::path& file) {
  RecordFileWriter out(file, kMagic);
  RecordWriter first, second;
  first.add(std::int32_t{-7});
  second.add(std::string("seven"));
  out.write(first);
  out.write(second);
  out.commit();
  CHECK(out.bytes() == std::filesystem::file_size(file));
}

void read_two(const std::filesystem::path& file) {
  RecordFileReader in(file, kMagic, "a test file");
  auto first = in.next("the number");
  CHECK(first.take<std::int32_t>() == -7);
  first.finish();
  auto second = in.next("the text");
  CHECK(second.take<std::string>() == "seven");
  second.finish();
  in.finish("the text");
}

std::string refusal(const std::filesystem::path& file) {
  try {
    read_two(file);
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

static_assert(!IsPlain<const char*>::value && !IsPlain<std::string_view>::value && !IsPlain<std::vector<int>>::value);
static_assert(IsPlain<Eigen::Vector3f>::value && IsPlain<Pose>::value && !IsPlain<Eigen::VectorXd>::value);
static_assert(SavedByFunctions<shapes::Circle> && !SavedByFunctions<std::shared_ptr<int>>);

TEST_CASE("a record gives back what was put into it") {
  RecordWriter out;
  const Pose pose = se3_exp((Twist() << 1, 2, 3, 0.1, 0.2, 0.3).finished());
  out.add(1.5);
  out.add(pose);
  out.add(std::vector<Eigen::Vector3f>{{1, 2, 3}, {4, 5, 6}});
  out.add(std::vector<std::string>{"", "two"});
  out.add(std::optional<int>());
  out.add(std::optional<Pose>(pose));
  out.add(std::vector<shapes::Circle>{{"small", 1}, {"large", 9}});

  RecordReader in(out.bytes(), "file", "record");
  CHECK(in.take<double>() == 1.5);
  CHECK(in.take<Pose>().matrix() == pose.matrix());
  CHECK(in.take<std::vector<Eigen::Vector3f>>()[1] == Eigen::Vector3f(4, 5, 6));
  CHECK(in.take<std::vector<std::string>>() == std::vector<std::string>{"", "two"});
  CHECK_FALSE(in.take<std::optional<int>>());
  CHECK(in.take<std::optional<Pose>>()->matrix() == pose.matrix());
  const auto circles = in.take<std::vector<shapes::Circle>>();
  REQUIRE(circles.size() == 2);
  CHECK(circles[1].name == "large");
  CHECK(circles[1].radius == 9);
  in.finish();
}

TEST_CASE("a record that is read otherwise than it was written is refused") {
  RecordWriter out;
  out.add(std::uint64_t{1000});
  RecordReader vector(out.bytes(), "state.bin", "the list");
  CHECK_THROWS_WITH(vector.take<std::vector<float>>(), Contains("state.bin") && Contains("the list is shorter than its counts say"));
  RecordReader half(out.bytes(), "state.bin", "the list");
  half.take<std::uint32_t>();
  CHECK_THROWS_WITH(half.finish(), Contains("the list has bytes left over"));
  CHECK_THROWS_WITH(half.take<double>(), Contains("is shorter"));
}

TEST_CASE("a file of records comes back, and is refused where it was cut, altered or prolonged") {
  test::TempFolder folder;
  const auto file = folder / "two.bin";
  write_two(file);
  read_two(file);
  const std::string bytes = bytes_of(file);
  auto with = [&](const std::string& content) {
    std::ofstream(folder / "other.bin", std::ios::binary) << content;
    return refusal(folder / "other.bin");
  };
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    INFO(length);
    REQUIRE_THAT(with(bytes.substr(0, length)), Contains("other.bin") && Contains("is cut short"));
  }
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    INFO(at);
    std::string altered = bytes;
    altered[at] = static_cast<char>(altered[at] ^ 4);
    REQUIRE_FALSE(with(altered).empty());
  }
  std::string altered = bytes;
  altered[17] = '!';
  CHECK_THAT(with(altered), Contains("the number was altered: its checksum differs (bytes 8 to 51)"));
  CHECK_THAT(with(bytes + "x"), Contains("goes on after the text"));
  CHECK_THAT(with("another kind of file"), Contains("is not a test file"));
  CHECK_THAT(refusal(folder / "none.bin"), Contains("cannot be opened"));
  CHECK_THAT(refusal(folder.path()), Contains("cannot be opened"));
}

TEST_CASE("a file of records that is not committed leaves the one before") {
  test::TempFolder folder;
  write_two(folder / "two.bin");
  {
    RecordFileWriter out(folder / "two.bin", kMagic);
    RecordWriter record;
    record.add(1);
    out.write(record);
  }
  read_two(folder / "two.bin");
}
