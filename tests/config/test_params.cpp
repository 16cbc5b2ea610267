#include <catch2/catch.hpp>
#include <numbers>

#include "framework/config/params.hpp"

using namespace ppm;
using Catch::Matchers::Contains;

namespace {

enum class Mode { literal, robust };

/// A module's worth of parameters, one of each type.
struct Example {
  bool smooth = true;
  int particles = 100;
  std::int64_t last = -1;
  double sigma_t = 0.02, turn = 0.1, share = 0.5;
  std::string title = "none", start = "reference";
  std::filesystem::path folder = "data";
  Eigen::Vector3d offset{0, 0, 1};
  Mode mode = Mode::robust;
  Params params;

  Example() {
    params.add("smooth", smooth);
    params.add("particles", particles).range(1, 1e6);
    params.add("last", last);
    params.add("sigma_t", sigma_t).unit("m").range(0, 10);
    params.add("turn", turn).unit("rad").above(0);
    params.add("share", share).range(0, 1);
    params.add("title", title);
    params.add("start", start).choices({"reference", "identity"});
    params.add("folder", folder);
    params.add("offset", offset).unit("m").range(-5, 5);
    params.add_choice("mode", mode, {{"literal", Mode::literal}, {"robust", Mode::robust}});
  }
  /// Parses a map; gives back the mistakes as "line:column message".
  std::vector<std::string> parse(const std::string& yaml) {
    const auto values = parse_yaml(yaml, "t.yaml");
    Diagnostics found;
    params.parse(&values, "test.example", Place{"t.yaml", 1, 1}, found);
    std::vector<std::string> out;
    for (const auto& d : found) out.push_back(fmt::format("{}:{} {}", d.place.line, d.place.column, d.message));
    return out;
  }
};

/// The one mistake in a map of parameters.
std::string mistake(const std::string& yaml) {
  Example e;
  const auto before = e.params.effective().to_yaml();
  const auto all = e.parse(yaml);
  REQUIRE(all.size() == 1);
  CHECK(e.params.effective().to_yaml() == before);
  return all[0];
}

}  // namespace

TEST_CASE("values reach their members in SI") {
  Example e;
  CHECK(e.parse("smooth: false\nparticles: 7\nlast: -12345678901\nsigma_t: 3 cm\nturn: 90 deg\nshare: 25 %\n"
                "title: some words\nstart: identity\nfolder: a/b c\noffset: [1 cm, -2, 3 mm]\nmode: literal\n")
            .empty());
  CHECK_FALSE(e.smooth);
  CHECK(e.particles == 7);
  CHECK(e.last == -12345678901);
  CHECK(e.sigma_t == 0.03);
  CHECK(e.turn == std::numbers::pi / 2);
  CHECK(e.share == 0.25);
  CHECK(e.title == "some words");
  CHECK(e.start == "identity");
  CHECK(e.folder == "a/b c");
  CHECK(e.offset == Eigen::Vector3d(0.01, -2, 0.003));
  CHECK(e.mode == Mode::literal);
}

TEST_CASE("without values the initialisers hold") {
  Example e;
  Diagnostics found;
  e.params.parse(nullptr, "test.example", Place{}, found);
  const Config nothing;
  e.params.parse(&nothing, "test.example", Place{}, found);
  CHECK(found.empty());
  CHECK(e.sigma_t == 0.02);
  CHECK(e.params.find("sigma_t")->default_text() == "0.02");
  CHECK(e.params.find("offset")->default_text() == "[0, 0, 1]");
  CHECK(e.params.find("mode")->default_text() == "robust");
  CHECK(e.params.find("nothing") == nullptr);
}

TEST_CASE("each kind of mistake, at its place, and the value stays") {
  CHECK(mistake("\nsigma_tt: 1\n") == "2:1 test.example has no parameter 'sigma_tt'; did you mean 'sigma_t'?");
  CHECK_THAT(mistake("zebra: 1\n"),
             Contains("1:1 test.example has no parameter 'zebra'; it has smooth, particles, last"));
  CHECK(mistake("sigma_t: 2 deg\n") == "1:10 sigma_t: '2 deg' is an angle; a length is wanted (m, km, cm, mm, um, µm)");
  CHECK(mistake("sigma_t: 11\n") == "1:10 sigma_t: '11' is out of range: from 0 m to 10 m");
  CHECK(mistake("sigma_t: -1 mm\n") == "1:10 sigma_t: '-1 mm' is out of range: from 0 m to 10 m");
  CHECK(mistake("turn: 0\n") == "1:7 turn: '0' must be above 0 rad");
  CHECK(mistake("particles: 0\n") == "1:12 particles: '0' is out of range: from 1 to 1000000");
  CHECK(mistake("particles: 1.5\n") == "1:12 particles: '1.5' is not an integer");
  CHECK(mistake("smooth: yes\n") == "1:9 smooth: 'yes' is not a boolean: write true or false");
  CHECK(mistake("start: identty\n") == "1:8 start: 'identty' is none of reference, identity; did you mean 'identity'?");
  CHECK(mistake("mode: mean\n") == "1:7 mode: 'mean' is none of literal, robust");
  CHECK(mistake("sigma_t: \"0.5\"\n") == "1:10 sigma_t: \"0.5\" is a text in quotes; a number (m) is wanted");
  CHECK(mistake("particles: '5'\n") == "1:12 particles: \"5\" is a text in quotes; an integer is wanted");
  CHECK(mistake("sigma_t:\n") == "1:1 sigma_t: no value is given; a number (m) is wanted");
  CHECK(mistake("title:\n") == "1:1 title: no value is given; a text is wanted (\"\" for an empty one)");
  CHECK(mistake("title: [a]\n") == "1:8 title: this is a list; a text is wanted");
  CHECK(mistake("share: {a: 1}\n") == "1:8 share: this is a map; a number is wanted");
  CHECK(mistake("offset: [1, 2]\n") == "1:9 offset: a list of three numbers is wanted, [x, y, z] in m");
  CHECK(mistake("offset: 1 2 3\n") == "1:9 offset: a list of three numbers is wanted, [x, y, z] in m");
  CHECK(mistake("offset: [1, 2 s, 3]\n") == "1:13 offset: '2 s' is a time; a length is wanted (m, km, cm, mm, um, µm)");
  CHECK(mistake("offset: [1, 2, 6]\n") == "1:16 offset: '6' is out of range: from -5 m to 5 m");
  CHECK(mistake("[1, 2]\n") == "1:1 the parameters of test.example are a map {name: value}, this is a list");
}

TEST_CASE("booleans are true and false, nothing else") {
  for (const char* word : {"yes", "no", "on", "off", "True", "FALSE", "y", "1", "0"})
    CHECK_THAT(mistake(std::string("smooth: ") + word), Contains("write true or false"));
  CHECK_THAT(mistake("smooth: \"true\""), Contains("in quotes"));
}

TEST_CASE("integers are decimal and fit") {
  Example e;
  CHECK(e.parse("{particles: +12, last: 0}").empty());
  CHECK(e.particles == 12);
  CHECK(e.parse("{last: 9223372036854775807}").empty());
  for (const char* word : {"1e3", "0x10", "1_000", "five", "+", "+-1", "1.0", "12 px", ".5"})
    CHECK_THAT(mistake(std::string("particles: ") + word), Contains("is not an integer"));
  CHECK_THAT(mistake("last: 010"), Contains("leading zero"));
  CHECK_THAT(mistake("last: -07"), Contains("leading zero"));
  CHECK_THAT(mistake("particles: 3000000000"), Contains("too large"));
  CHECK_THAT(mistake("last: 9223372036854775808"), Contains("too large"));
}

TEST_CASE("numbers are finite") {
  for (const char* word : {".nan", ".inf", "-.inf", "nan", "inf"}) {
    CHECK_THAT(mistake(std::string("turn: ") + word), Contains("is not a number"));
    CHECK_THAT(mistake(fmt::format("offset: [0, {}, 0]", word)), Contains("is not a number"));
  }
}

TEST_CASE("every mistake is told, in the order of the file, and what is right is set") {
  Example e;
  const auto found =
      e.parse("sigma_t: 2 s\nparticles: 5\nsmoth: true\nturn: -1\noffset: [a, 0, 0]\nmode: x\nlast: 1.5\n");
  REQUIRE(found.size() == 6);
  for (std::size_t i = 0; i < 6; ++i)
    CHECK(found[i].substr(0, 2) == std::vector<std::string>{"1:", "3:", "4:", "5:", "6:", "7:"}[i]);
  CHECK(e.particles == 5);
}

TEST_CASE("required parameters") {
  double size = 1;
  Params params;
  params.add("size", size).unit("m").required();
  CHECK(params.find("size")->default_text() == "");
  Diagnostics found;
  params.parse(nullptr, "test.box", Place{"t.yaml", 9, 3}, found);
  REQUIRE(found.size() == 1);
  CHECK(found[0].message == "test.box needs the parameter 'size'");
  CHECK(found[0].place.line == 9);
  CHECK(found[0].place.column == 3);
  found.clear();
  const auto values = parse_yaml("size: 2 m", "t");
  params.parse(&values, "test.box", Place{}, found);
  CHECK(found.empty());
  CHECK(size == 2);
}

TEST_CASE("a further check looks at each value that is given, whatever else is wrong") {
  int packet = 8, other = 0;
  Params params;
  params.add("packet", packet).range(1, 16).check([&] { return packet % 2 == 0 ? "" : "must be even"; });
  params.add("other", other);
  auto parse = [&](const std::string& yaml) {
    std::string told;
    Diagnostics found;
    const auto values = parse_yaml(yaml, "t");
    params.parse(&values, "test.check", Place{"t", 5, 5}, found);
    for (const auto& d : found) told += fmt::format("{}:{} {}\n", d.place.line, d.place.column, d.message);
    return told;
  };
  CHECK(parse("{packet: 4}") == "");
  CHECK(parse("{packet: 3}") == "1:10 packet: must be even\n");
  CHECK(parse("{packet: 3, other: x}") == "1:10 packet: must be even\n1:20 other: 'x' is not an integer\n");
  CHECK(parse("{packet: 17}") == "1:10 packet: '17' is out of range: from 1 to 16\n");  // one mistake is told once
}

TEST_CASE("effective values read back give the same values") {
  Example e;
  e.sigma_t = 0.1 + 0.2;  // 17 digits
  e.turn = 1e-300;
  e.title = "a: b # c";
  e.folder = "";
  e.offset = {1.0 / 3, -2e-17, 5};
  e.mode = Mode::literal;
  e.last = -9'000'000'000'000'000'000;
  const auto text = e.params.effective().to_yaml();
  Example back;
  CHECK(back.parse(text).empty());
  CHECK(back.sigma_t == e.sigma_t);
  CHECK(back.turn == e.turn);
  CHECK(back.title == e.title);
  CHECK(back.folder == e.folder);
  CHECK(back.offset == e.offset);
  CHECK(back.mode == e.mode);
  CHECK(back.last == e.last);
  CHECK(back.params.effective().to_yaml() == text);
}

TEST_CASE("declarations that make no sense are our own bug") {
  Example e;
  double x = 0;
  std::string s;
  bool b = false;
  CHECK_THROWS_AS(e.params.add("sigma_t", x), InternalError);
  CHECK_THROWS_AS(e.params.add("a", x).unit("cm"), InternalError);
  CHECK_THROWS_AS(e.params.add("b", s).unit("m"), InternalError);
  CHECK_THROWS_AS(e.params.add("c", b).range(0, 1), InternalError);
  CHECK_THROWS_AS(e.params.add("d", x).range(2, 1), InternalError);
  CHECK_THROWS_AS(e.params.add("e", x).choices({"a"}), InternalError);
  x = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(e.params.add("f", x), InternalError);
  Mode mode = static_cast<Mode>(5);
  CHECK_THROWS_AS(e.params.add_choice<Mode>("g", mode, {{"literal", Mode::literal}}), InternalError);
}
