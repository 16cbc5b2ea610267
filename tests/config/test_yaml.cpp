#include <catch2/catch.hpp>

#include "framework/config/config.hpp"
#include "framework/core/atomic_file.hpp"
#include "framework/core/rng.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

/// Every mistake in a text, as "line:column message".
std::vector<std::string> mistakes(const std::string& text) {
  std::vector<std::string> out;
  try {
    parse_yaml(text, "t.yaml");
  } catch (const ConfigError& e) {
    for (const auto& d : e.diagnostics()) {
      CHECK(d.place.file == "t.yaml");
      out.push_back(fmt::format("{}:{} {}", d.place.line, d.place.column, d.message));
    }
  }
  return out;
}

std::string at(const Config& c) {
  return fmt::format("{}:{}", c.place().line, c.place().column);
}

bool same(const Config& a, const Config& b) {
  if (a.kind() != b.kind() || a.text() != b.text() || a.items().size() != b.items().size() ||
      a.entries().size() != b.entries().size())
    return false;
  for (std::size_t i = 0; i < a.items().size(); ++i)
    if (!same(a.items()[i], b.items()[i])) return false;
  for (std::size_t i = 0; i < a.entries().size(); ++i)
    if (a.entries()[i].key != b.entries()[i].key || !same(a.entries()[i].value, b.entries()[i].value)) return false;
  return true;
}

}  // namespace

TEST_CASE("every value knows its place") {
  const auto c = parse_yaml(
      "name: room\n"
      "# a comment\n"
      "nodes:\n"
      "  - {name: camera, params: {frames: 200}}\n"
      "  - name: init\n"
      "    list: [1, \"2\"]\n"
      "empty:\n",
      "t.yaml");
  CHECK(c.place().file == "t.yaml");
  CHECK(at(c) == "1:1");
  CHECK(at(*c.find("name")) == "1:7");
  CHECK(c.entries()[1].key_place.line == 3);
  CHECK(c.entries()[1].key_place.column == 1);
  const auto& nodes = c.find("nodes")->items();
  REQUIRE(nodes.size() == 2);
  CHECK(at(*nodes[0].find("name")) == "4:12");
  CHECK(at(*nodes[0].find("params")->find("frames")) == "4:37");
  CHECK(nodes[0].find("params")->entries()[0].key_place.column == 29);
  CHECK(at(nodes[1]) == "5:5");
  CHECK(at(nodes[1].find("list")->items()[1]) == "6:15");
  CHECK(c.find("empty")->kind() == Config::Kind::null);
  CHECK(at(*c.find("empty")) == "7:1");
}

TEST_CASE("scalars stay texts, quotes are remembered") {
  const auto c = parse_yaml("a: yes\nb: 010\nc: 'yes'\nd: \"x\\ty\"\ne: ~\nf: two words\n", "t.yaml");
  CHECK(c.find("a")->text() == "yes");
  CHECK(c.find("b")->text() == "010");
  CHECK_FALSE(c.find("b")->quoted());
  CHECK(c.find("c")->quoted());
  CHECK(c.find("d")->text() == "x\ty");
  CHECK(c.find("e")->kind() == Config::Kind::null);
  CHECK(c.find("f")->text() == "two words");
  CHECK(c.find("nothing") == nullptr);
}

TEST_CASE("an empty text is nothing, at its beginning") {
  for (const char* text : {"", "\n", "# only a comment\n", "---\n"}) {
    const auto c = parse_yaml(text, "t.yaml");
    CHECK(c.kind() == Config::Kind::null);
    CHECK(c.place().line == 1);
  }
}

TEST_CASE("what YAML lets pass and we do not, each at its place") {
  CHECK(mistakes("a: 1\nb: 2\na: 3\n") == std::vector<std::string>{"3:1 key 'a' is there already, at line 1"});
  CHECK(mistakes("n: {x: 1, y: 2, x: 3}\n") == std::vector<std::string>{"1:17 key 'x' is there already, at line 1"});
  CHECK(mistakes("a: &one 1\n") ==
        std::vector<std::string>{"1:4 anchors (&name) are not supported: write the value out"});
  CHECK_THAT(mistakes("a: &m\n  b: 1\nc: *m\n").at(1), StartsWith("3:4 aliases"));
  CHECK_THAT(mistakes("a:\n  <<: {b: 1}\n").at(0), StartsWith("2:3 merge keys"));
  CHECK_THAT(mistakes("a: !!str 4\n").at(0), Contains("tags"));
  CHECK_THAT(mistakes("? [a, b]\n: 3\n").at(0), StartsWith("1:3 a key must be a word, this is a list"));
  CHECK_THAT(mistakes("a: 1\n---\nb: 2\n").at(0), StartsWith("2:1 a second document"));
  CHECK_THAT(mistakes("a:\n\t- 1\n").at(0), StartsWith("2:1 a tab as indentation"));
  CHECK_THAT(mistakes("a:\n  \tb: 1\n").at(0), StartsWith("2:3 a tab as indentation"));
  CHECK(mistakes("a: 1\t# a tab before a comment\n\t# and a comment after one\n").empty());
}

TEST_CASE("broken syntax has a place") {
  CHECK_THAT(mistakes("a: [1, 2\nb: 3\n").at(0), StartsWith("2:2 YAML syntax: "));
  CHECK_THAT(mistakes("a: 1\n  b: 2\n").at(0), StartsWith("2:4 YAML syntax: "));
  CHECK(mistakes("a: \"open\n") == std::vector<std::string>{"1:4 this quote is never closed"});
  CHECK(mistakes("µ: 1\nb: 'it''s open\n") == std::vector<std::string>{"2:4 this quote is never closed"});
  CHECK(mistakes("a: \"x \\\" y\"\nb: 'it''s'\nc: |\n  \"text\n").empty());
  CHECK_THAT(mistakes("a: @x\n").at(0), StartsWith("1:4 YAML syntax: "));
}

TEST_CASE("all mistakes come in one error") {
  CHECK(mistakes("a: &x 1\na: 2\nb: *x\n<<: 1\nc: !!int 3\n").size() == 5);
  // a syntax error ends the reading, but what was found before it is told
  CHECK(mistakes("a: 1\na: 2\nb: [\n").size() == 2);
}

TEST_CASE("changing a tree") {
  Config c;
  c.set("a", Place{"f", 1, 1}, Config::scalar("1", Place{}));
  c.set("b", Place{"f", 2, 1}, Config::sequence({Config::scalar("2", Place{})}, Place{}));
  c.set("a", Place{"f", 3, 1}, Config::scalar("3", Place{}));
  CHECK(c.kind() == Config::Kind::map);
  CHECK(c.to_yaml() == "a: 3\nb: [2]\n");
  auto list = Config::sequence({}, Place{});
  CHECK_THROWS_AS(list.set("a", Place{}, Config()), InternalError);
}

TEST_CASE("to_yaml writes blocks, and lists of values on one line") {
  const auto c =
      parse_yaml("{name: room, nodes: [{name: a, params: {x: [1, 2 cm], e: {}, l: []}}, {name: b}], n: }", "t");
  CHECK(c.to_yaml() ==
        "name: room\n"
        "nodes:\n"
        "  - name: a\n"
        "    params:\n"
        "      x: [1, 2 cm]\n"
        "      e: {}\n"
        "      l: []\n"
        "  - name: b\n"
        "n: null\n");
}

TEST_CASE("to_yaml and back gives the same tree") {
  const char* texts[] = {"a: 1",
                         "just a word",
                         "[1, [2, 3], {a: b}, []]",
                         "",
                         "a: {b: {c: {d: [x, y: z]}}}",
                         "- - - 1\n    - 2\n  - 3\n- a: 1\n  b: 2\n"};
  for (const char* text : texts) {
    CAPTURE(text);
    const auto c = parse_yaml(text, "t");
    CHECK(same(parse_yaml(c.to_yaml(), "t"), c));
  }
}

TEST_CASE("any text survives as value, list item and key") {
  const std::string awkward[] = {"",       " ",     "null",  "~",    "yes", "010",      "a: b",    "a #b", "#a",
                                 "- a",    "-",     "-1",    "?",    "? a", ":",        ":a",      "a:",   "[a]",
                                 "{a}",    "a, b",  "a]",    "&a",   "*a",  "!a",       "|",       ">",    "'a'",
                                 "\"a\"",  "it's",  "a\\b",  "%a",   "@a",  "`a",       "a\nb",    "a\tb", "\x01",
                                 "\x7f",   "---",   "--- a", "...",  "<<",  "µm",       "深さ",    "2 cm", " lead",
                                 "trail ", "x\r\n", "a?b:c", "a{b}", "-a",  "http://x", "C:\\x y", "=",    "~/data"};
  for (const auto& text : awkward) {
    CAPTURE(text);
    Config c;
    c.set("value", Place{}, Config::scalar(text, Place{}));
    c.set("list", Place{}, Config::sequence({Config::scalar(text, Place{}), Config::scalar("1", Place{})}, Place{}));
    c.set("k" + text, Place{}, Config::scalar("1", Place{}));
    c.set(text, Place{}, Config::scalar("2", Place{}));
    Config deep;
    deep.set("items", Place{}, Config::sequence({c, c}, Place{}));
    CAPTURE(deep.to_yaml());
    Config back;
    REQUIRE_NOTHROW(back = parse_yaml(deep.to_yaml(), "t"));
    CHECK(same(back, deep));
  }
}

TEST_CASE("a damaged text is read or refused with a place, and what is read survives to_yaml") {
  const std::string sound =
      "name: \"a b\"\nlist: [1, 'x''y', {a: b}]\nlines: |\n  text\n  more\nfolded: >\n  some\n  words\n"
      "n:\n- - 1\n  - b: c\n    d: {e: [2 cm, -3], f: }\n- plain text # a comment\n";
  const std::string pieces[] = {"{", "}", "[",  "]", ": ", "- ",    "\n",    "'", "\"", "&a ",  "*a", "!!x ", "#", "|",
                                ">", "%", "? ", ",", "\t", "---\n", "...\n", "~", "\\", "\x80", "µ",  "\r\n", "  "};
  Rng rng(1, 0, 0, 0);
  int read = 0, refused = 0;
  for (int n = 0; n < 2000; ++n) {
    std::string text = sound;
    for (auto k = 1 + rng.below(2); k > 0; --k) {
      const auto at = rng.below(static_cast<std::uint32_t>(text.size()));
      const auto kind = rng.below(4);
      if (kind == 0) text[at] = static_cast<char>(rng.below(256));
      if (kind == 1) text.erase(at, rng.below(10));
      if (kind >= 2) text.insert(at, pieces[rng.below(std::size(pieces))]);
    }
    CAPTURE(text);
    try {
      const auto c = parse_yaml(text, "t");
      ++read;
      REQUIRE(same(parse_yaml(c.to_yaml(), "t"), c));
    } catch (const ConfigError& e) {
      ++refused;
      for (const auto& d : e.diagnostics()) REQUIRE(d.place.line >= 1);
    }
  }
  CHECK(read > 400);
  CHECK(refused > 400);
}

TEST_CASE("files that cannot be read") {
  test::TempFolder folder;
  CHECK_THROWS_AS(load_yaml(folder / "no.yaml"), ConfigError);
  CHECK_THROWS_WITH(load_yaml(folder / "no.yaml"), Contains("no.yaml: cannot read: No such file or directory"));
  CHECK_THROWS_WITH(load_yaml(folder.path()), Contains("this is a folder"));
  write_file(folder / "empty.yaml", "");
  CHECK(load_yaml(folder / "empty.yaml").kind() == Config::Kind::null);
  write_file(folder / "a.yaml", "a: 1\na: 2\n");
  CHECK_THROWS_WITH(load_yaml(folder / "a.yaml"), Contains("a.yaml:2:1: key 'a'"));
}
