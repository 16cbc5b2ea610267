// GLB as another program reads it: tinygltf.
#include <catch2/catch.hpp>
#include <cstring>
#include <tiny_gltf.h>

#include "modules/maps/export/export.hpp"
#include "tests/export/export_maps.hpp"

using namespace ppm;

namespace {

tinygltf::Model read(const std::string& bytes) {
  tinygltf::TinyGLTF reader;
  tinygltf::Model model;
  std::string error, warning;
  const bool read = reader.LoadBinaryFromMemory(&model, &error, &warning,
                                                reinterpret_cast<const unsigned char*>(bytes.data()),
                                                static_cast<unsigned>(bytes.size()));
  INFO(error << warning);
  REQUIRE(read);
  CHECK(error.empty());
  CHECK(warning.empty());
  return model;
}

template <class T>
std::vector<T> values(const tinygltf::Model& model, int accessor) {
  const auto& a = model.accessors[static_cast<std::size_t>(accessor)];
  const auto& view = model.bufferViews[static_cast<std::size_t>(a.bufferView)];
  const auto width = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<unsigned>(a.type)));
  REQUIRE(static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<unsigned>(a.componentType))) == sizeof(T));
  std::vector<T> out(a.count * width);
  REQUIRE(view.byteLength >= out.size() * sizeof(T));
  std::memcpy(out.data(), model.buffers[0].data.data() + view.byteOffset + a.byteOffset, out.size() * sizeof(T));
  return out;
}

std::string glb_of(const Map& map, Surface surface, std::optional<Show> show = {}) {
  ExportSettings settings;
  settings.format = ExportFormat::glb;
  settings.surface = surface;
  settings.show = show;
  settings.picture.up = Up::z;
  return export_map(map, settings, "map.glb", "map.ppm").files.back().bytes;
}

}  // namespace

TEST_CASE("the base of a map as GLB: a mesh a chunk with texture, and its texels exactly") {
  const auto map = test::textured_sheet();
  const auto model = read(glb_of(*map, Surface::base));
  std::size_t chunks = 0;
  for (const auto& chunk : map->table().chunks()) {
    if (chunk.geometry->face.empty()) continue;
    const auto& mesh = model.meshes.at(chunks++);
    const auto& primitive = mesh.primitives.at(0);
    const auto position = values<float>(model, primitive.attributes.at("POSITION"));
    REQUIRE(position.size() == 9 * chunk.geometry->face.size());
    for (std::size_t f = 0; f < chunk.geometry->face.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        REQUIRE(Eigen::Map<const Eigen::Vector3f>(&position[9 * f + 3 * k]) ==
                chunk.geometry->position[chunk.geometry->face[f][k]]);
    auto raw = [&](const char* name) { return mesh.extras.Get(name).GetNumberAsInt(); };
    CHECK(values<float>(model, raw("texel_mean")) == chunk.texels->mean);
    CHECK(values<float>(model, raw("texel_variance")) == chunk.texels->variance);
    CHECK(values<std::uint8_t>(model, raw("face_divisions")) == chunk.geometry->divisions);
    CHECK(values<float>(model, raw("face_excess")).size() == chunk.geometry->face.size());
    CHECK(values<float>(model, primitive.attributes.at("_SIGMA")).size() == position.size() / 3);
    for (const float uv : values<float>(model, primitive.attributes.at("TEXCOORD_0"))) CHECK((uv > 0 && uv < 1));
    const auto& material = model.materials.at(static_cast<std::size_t>(primitive.material));
    const auto texture = static_cast<std::size_t>(material.pbrMetallicRoughness.baseColorTexture.index);
    const auto& image = model.images.at(static_cast<std::size_t>(model.textures.at(texture).source));
    CHECK(image.width > 1);
    CHECK(image.image.size() >= static_cast<std::size_t>(3 * image.width * image.height));
  }
  CHECK(chunks > 1);
  CHECK(model.meshes.size() == chunks);
  const auto& extras = model.scenes.at(0).extras;
  CHECK(extras.Get("colors").Get<std::string>() == "sigma");
  CHECK(extras.Get("scale").Get<std::string>() == "logarithmic");
  CHECK(extras.Get("scale_low").GetNumberAsDouble() < extras.Get("scale_high").GetNumberAsDouble());
}

TEST_CASE("the displaced surface as GLB: one mesh with colours at its vertices, upwards turned to y") {
  const auto map = test::textured_sheet();
  const Mesh mesh = map->mesh(Surface::displaced);
  const auto model = read(glb_of(*map, Surface::displaced, Show::mean));
  REQUIRE(model.meshes.size() == 1);
  const auto& primitive = model.meshes[0].primitives.at(0);
  CHECK(values<float>(model, primitive.attributes.at("POSITION")).size() == 3 * mesh.position.size());
  CHECK(values<float>(model, primitive.attributes.at("_MEAN")) == mesh.mean);
  CHECK(values<std::uint32_t>(model, primitive.indices).size() == 3 * mesh.face.size());
  CHECK(values<std::uint16_t>(model, primitive.attributes.at("COLOR_0")).size() == 4 * mesh.position.size());
  const auto& q = model.nodes.at(0).rotation;
  const Eigen::Quaterniond R(q.at(3), q.at(0), q.at(1), q.at(2));
  CHECK((R * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitY()).norm() < 1e-6);
  CHECK(model.nodes[0].children.size() == 1);
}

TEST_CASE("GLB of each kind of colour, of grey and colour maps, and of nothing") {
  for (const int channels : {0, 1, 3})
    for (const auto& [name, show] : show_names()) {
      if (show == Show::color && channels == 0) continue;
      INFO(name << " " << channels);
      const auto map = test::textured_sheet(channels);
      const auto model = read(glb_of(*map, Surface::base, show));
      CHECK(model.images.empty() == (show == Show::shaded));
      CHECK(model.meshes.at(0).extras.Has("texel_color") == (channels > 0));
      read(glb_of(*map, Surface::displaced, show));
    }
  CHECK(read(glb_of(PpmMap{PpmSettings{}}, Surface::base, Show::sigma)).meshes.empty());
  CHECK(read(glb_of(PpmMap{PpmSettings{}}, Surface::displaced, Show::sigma)).meshes.empty());
}
