#include <catch2/catch.hpp>

#include "framework/core/digest.hpp"

using namespace ppm;

TEST_CASE("digest: the empty input's published hash, independence of the cuts, dependence on every byte") {
  CHECK(Digest().hex() == "99aa06d3014798d86001c324468d497f");  // XXH3_128bits("", 0), xxHash's sanity checks

  std::vector<unsigned char> bytes(5000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(i * 7);
  Digest whole, parts;
  whole.add(bytes.data(), bytes.size());
  parts.add(bytes.data(), 1);
  parts.add(bytes.data() + 1, 1000);
  CHECK(parts.hex() != whole.hex());
  parts.add(bytes.data() + 1001, 3999);
  CHECK(parts.hex() == whole.hex());

  bytes[4999] ^= 1;
  Digest other;
  other.add(bytes.data(), bytes.size());
  CHECK(other.hex() != whole.hex());
}

TEST_CASE("digest: lengths are part of it") {
  Digest a, b;
  a.add(std::string("ab"));
  a.add(std::string("c"));
  b.add(std::string("a"));
  b.add(std::string("bc"));
  CHECK(a.hex() != b.hex());
  Digest c, d;
  c.add(std::vector<float>{1, 2});
  c.add(std::vector<float>{});
  d.add(std::vector<float>{1});
  d.add(std::vector<float>{2});
  CHECK(c.hex() != d.hex());
}
