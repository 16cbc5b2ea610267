#include "modules/maps/export/glb.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "modules/maps/export/bytes.hpp"

namespace ppm {
namespace {

using Json = nlohmann::ordered_json;

// Constants of the format.
constexpr int kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kLinear = 9729, kClampToEdge = 33071;
constexpr int kNoTarget = 0;

/// Vertex colours are linear light in glTF, textures are sRGB.
std::uint16_t linear_light(float srgb) {
  const float c = std::clamp(srgb, 0.0f, 1.0f);
  const float light = c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
  return static_cast<std::uint16_t>(std::lround(65535 * light));
}

class Writer {
 public:
  explicit Writer(const GlbScene& scene) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "ppm"}};
    json_["scene"] = 0;
    const auto& q = scene.R_gltf_map;
    Json map = {{"name", "map"}, {"rotation", {q.x(), q.y(), q.z(), q.w()}}};
    json_["scenes"] = {{{"name", "map"}, {"nodes", {0}}, {"extras", extras_of(scene)}}};
    json_["nodes"] = {map};
    for (const auto& mesh : scene.meshes) add_mesh(mesh);
  }

  std::string bytes() {
    if (!binary_.empty()) json_["buffers"] = {{{"byteLength", binary_.size()}}};
    std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string file = "glTF";
    const std::size_t chunks = binary_.empty() ? 8 + text.size() : 16 + text.size() + binary_.size();
    add_word(file, 2);
    add_word(file, 12 + chunks);
    add_chunk(file, "JSON", text);
    if (!binary_.empty()) add_chunk(file, std::string_view("BIN\0", 4), binary_);
    return file;
  }

 private:
  static Json extras_of(const GlbScene& scene) {
    Json extras = Json::object();
    for (const auto& [name, text] : scene.notes) extras[name] = text;
    for (const auto& [name, number] : scene.numbers) extras[name] = number;
    return extras;
  }
  static void add_word(std::string& file, std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    append(file, &word, 1);
  }
  static void add_chunk(std::string& file, std::string_view type, const std::string& content) {
    add_word(file, content.size());
    file += type;
    file += content;
  }

  template <class T>
  std::size_t add_view(const T* values, std::size_t count, int target) {
    Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", count * sizeof(T)}};
    if (target != kNoTarget) view["target"] = target;
    append(binary_, values, count);
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    json_["bufferViews"].push_back(std::move(view));
    return json_["bufferViews"].size() - 1;
  }
  template <class T>
  std::size_t add_accessor(const T* values, std::size_t count, std::size_t width, int component, const char* type,
                           int target) {
    Json accessor = {{"bufferView", add_view(values, count * width, target)},
                     {"componentType", component},
                     {"count", count},
                     {"type", type}};
    json_["accessors"].push_back(std::move(accessor));
    return json_["accessors"].size() - 1;
  }
  std::size_t add_scalars(const std::vector<float>& values, int target = kNoTarget) {
    return add_accessor(values.data(), values.size(), 1, kFloat, "SCALAR", target);
  }

  std::size_t add_positions(const std::vector<Eigen::Vector3f>& position) {
    const auto accessor = add_accessor(position[0].data(), position.size(), 3, kFloat, "VEC3", kArrayBuffer);
    Eigen::AlignedBox3f box;
    for (const auto& p : position) box.extend(p);
    json_["accessors"][accessor]["min"] = {box.min().x(), box.min().y(), box.min().z()};
    json_["accessors"][accessor]["max"] = {box.max().x(), box.max().y(), box.max().z()};
    return accessor;
  }
  std::size_t add_colors(const std::vector<Color>& colors) {
    std::vector<std::uint16_t> light;
    light.reserve(4 * colors.size());
    for (const auto& c : colors)
      light.insert(light.end(), {linear_light(c.x()), linear_light(c.y()), linear_light(c.z()), 65535});
    const auto accessor = add_accessor(light.data(), colors.size(), 4, kUnsignedShort, "VEC4", kArrayBuffer);
    json_["accessors"][accessor]["normalized"] = true;
    return accessor;
  }

  std::size_t add_material(const std::string& png) {
    Json surface = {{"metallicFactor", 0}, {"roughnessFactor", 1}};
    if (!png.empty()) {
      if (!json_.contains("samplers"))
        json_["samplers"] = {
            {{"magFilter", kLinear}, {"minFilter", kLinear}, {"wrapS", kClampToEdge}, {"wrapT", kClampToEdge}}};
      json_["images"].push_back({{"bufferView", add_view(png.data(), png.size(), kNoTarget)}, {"mimeType", "image/png"}});
      const std::size_t image = json_["images"].size() - 1;
      json_["textures"].push_back({{"sampler", 0}, {"source", image}});
      surface["baseColorTexture"] = {{"index", image}};
    } else if (plain_material_) {
      return *plain_material_;
    }
    json_["materials"].push_back({{"pbrMetallicRoughness", std::move(surface)}});
    const std::size_t material = json_["materials"].size() - 1;
    if (png.empty()) plain_material_ = material;
    return material;
  }

  void add_mesh(const GlbMesh& mesh) {
    if (mesh.position.empty()) return;
    Json attributes = {{"POSITION", add_positions(mesh.position)}};
    attributes["NORMAL"] = add_accessor(mesh.normal[0].data(), mesh.normal.size(), 3, kFloat, "VEC3", kArrayBuffer);
    if (!mesh.uv.empty())
      attributes["TEXCOORD_0"] = add_accessor(mesh.uv[0].data(), mesh.uv.size(), 2, kFloat, "VEC2", kArrayBuffer);
    if (!mesh.color.empty()) attributes["COLOR_0"] = add_colors(mesh.color);
    attributes["_MEAN"] = add_scalars(mesh.mean, kArrayBuffer);
    attributes["_SIGMA"] = add_scalars(mesh.sigma, kArrayBuffer);
    Json primitive = {{"attributes", std::move(attributes)}, {"material", add_material(mesh.png)}};
    if (!mesh.face.empty())
      primitive["indices"] = add_accessor(mesh.face[0].data(), 3 * mesh.face.size(), 1, kUnsignedInt, "SCALAR",
                                          kElementArrayBuffer);
    Json object = {{"name", mesh.name}, {"primitives", {std::move(primitive)}}};
    if (!mesh.texels.mean.empty()) object["extras"] = add_texels(mesh.texels);
    json_["meshes"].push_back(std::move(object));
    json_["nodes"].push_back({{"name", mesh.name}, {"mesh", json_["meshes"].size() - 1}});
    json_["nodes"][0]["children"].push_back(json_["nodes"].size() - 1);
  }

  /// Accessors that no attribute uses: programs that do not know them pass them by.
  Json add_texels(const GlbTexels& texels) {
    const auto& n = texels.divisions;
    Json extras = {{"texel_mean", add_scalars(texels.mean)},
                   {"texel_variance", add_scalars(texels.variance)},
                   {"face_excess", add_scalars(texels.excess)},
                   {"face_divisions", add_accessor(n.data(), n.size(), 1, kUnsignedByte, "SCALAR", kNoTarget)}};
    if (texels.color.empty()) return extras;
    extras["texel_color"] = add_scalars(texels.color);
    extras["texel_color_variance"] = add_scalars(texels.color_variance);
    return extras;
  }

  Json json_;
  std::string binary_;
  std::optional<std::size_t> plain_material_;
};

}  // namespace

std::string to_glb(const GlbScene& scene) {
  return Writer(scene).bytes();
}

}  // namespace ppm
