#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <zlib.h>

#include "framework/core/error.hpp"
#include "framework/graph/registry.hpp"
#include "framework/slam/frame.hpp"
#include "modules/rawlog/rawlog.hpp"

namespace ppm {
namespace {

std::string gzipped(const std::string& bytes) {
  z_stream stream{};
  constexpr int kGzip = 15 + 16;  // window bits, and the format
  PPM_CHECK(deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY) == Z_OK, "zlib does not start");
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  PPM_CHECK(deflate(&stream, Z_FINISH) == Z_STREAM_END, "zlib does not end");
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

/// Records frames as a rawlog of MRPT, observations alone: range images (and colour), inertial samples, odometry and
/// reference poses; source.rawlog gives the same frames again. Not recorded: sigma and confidence; depth is rounded to
/// range_unit, times to 0.1 us. While the run lasts the file is called NAME.part.
class RawlogSink final : public Module {
 public:
  In<Frame> frame{this, "frame", "The image to be recorded."};

  RawlogSink() {
    params_.add("file", file_).doc("Name of the file in the run's directory.");
    params_.add("compress", compress_).doc("Whether the file is compressed with gzip.");
    params_.add("range_unit", format_.range_unit_m)
        .unit("m")
        .range(1e-5, 0.1)
        .doc("What depths are rounded to, a whole part of a metre; 65,535 of them are the farthest that fits.");
    params_.add("camera", format_.label).doc("Label of the camera.");
  }

  void open(Context& context) override {
    final_ = context.output(file_);
    part_ = final_.string() + ".part";
  }

  void tick(Context&) override {
    if (!out_) begin("wb");
    std::string bytes = RawlogLibrary::get().frame_bytes(*frame, format_);
    if (compress_) bytes = gzipped(bytes);  // members in a row are one stream
    if (std::fwrite(bytes.data(), 1, bytes.size(), out_.get()) != bytes.size() || std::fflush(out_.get()) != 0) fail();
    written_ += bytes.size();
  }

  void close(Context&) override {
    if (!out_) return;
    if (std::fclose(out_.release()) != 0) fail();
    std::filesystem::rename(part_, final_);
  }

  void save(RecordWriter& out) const override { out.add(written_); }
  void load(RecordReader& in) override {
    in.take(written_);
    if (written_ == 0) return;
    std::error_code error;
    if (!std::filesystem::exists(part_)) std::filesystem::rename(final_, part_, error);  // the run was ended in order
    const auto size = error ? 0 : std::filesystem::file_size(part_, error);
    if (error || size < written_) in.fail(fmt::format("what was recorded is not there any more: {}", final_.string()));
    std::filesystem::resize_file(part_, written_);
    begin("ab");
  }

 private:
  void begin(const char* mode) {
    out_.reset(std::fopen(part_.c_str(), mode));
    if (!out_) fail();
  }
  [[noreturn]] void fail() const { throw OutputError(fmt::format("{}: {}", part_.string(), std::strerror(errno))); }

  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  std::string file_ = "frames.rawlog";
  bool compress_ = true;
  RawlogFormat format_;
  std::filesystem::path final_, part_;
  std::unique_ptr<std::FILE, Close> out_;
  std::uint64_t written_ = 0;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::RawlogSink>("sink.rawlog", "Records frames as a rawlog of MRPT, which source.rawlog reads.",
                         "MRPT, mrpt::obs::CRawlog");
}
