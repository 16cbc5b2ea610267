#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

#include "framework/core/record.hpp"

namespace ppm {

/// values[i] becomes values[ancestors[i]].
template <class T>
void gather(std::vector<T>& values, const std::vector<std::uint32_t>& ancestors) {
  std::vector<T> next;
  next.reserve(ancestors.size());
  for (auto a : ancestors) next.push_back(values[a]);
  values = std::move(next);
}

/// A column of a ParticleSet whose type only its owner knows.
class ColumnBase {
 public:
  virtual ~ColumnBase() = default;
  virtual void gather(const std::vector<std::uint32_t>& ancestors) = 0;
  virtual void resize(std::size_t n) = 0;
  virtual std::type_index type() const = 0;
  /// The compiler's name of the type, for files.
  virtual std::string type_name() const { return type().name(); }
  /// The value of particle i, as bytes.
  virtual std::string saved(std::size_t i) const = 0;
};

/// State per particle that resampling moves with the particle. Bytes: T should be small or a handle.
/// Checkpoints keep it: T is what a RecordWriter takes.
template <class T>
class Column final : public ColumnBase {
 public:
  std::vector<T> values;
  T& operator[](std::size_t i) { return values[i]; }
  const T& operator[](std::size_t i) const { return values[i]; }
  void resize(std::size_t n) override { values.resize(n); }
  std::type_index type() const override { return typeid(T); }
  void gather(const std::vector<std::uint32_t>& ancestors) override { ppm::gather(values, ancestors); }
  std::string saved(std::size_t i) const override {
    RecordWriter out;
    out.add(values[i]);
    return out.bytes();
  }
};

/// A column as it came from a file, until its owner asks for it and so says what type it has: bytes that move with
/// their particles.
class SavedColumn final : public ColumnBase {
 public:
  /// values: of each particle; file and name: for messages.
  SavedColumn(std::string type_name, std::vector<std::string> values, std::string file, std::string name)
      : type_name_(std::move(type_name)), values_(std::move(values)), file_(std::move(file)), name_(std::move(name)) {}
  void resize(std::size_t n) override { values_.resize(n); }
  std::type_index type() const override { return typeid(void); }
  std::string type_name() const override { return type_name_; }
  void gather(const std::vector<std::uint32_t>& ancestors) override { ppm::gather(values_, ancestors); }
  std::string saved(std::size_t i) const override { return values_[i]; }

  /// The column with its type. A particle that a resize() added gets a default value. Throws DataError where the type is another
  /// than was saved.
  template <class T>
  std::unique_ptr<Column<T>> as() const {
    check_type(typeid(T).name());
    auto column = std::make_unique<Column<T>>();
    column->resize(values_.size());
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (values_[i].empty()) continue;
      RecordReader in(values_[i], file_, "column '" + name_ + "'");
      in.take(column->values[i]);
      in.finish();
    }
    return column;
  }

 private:
  void check_type(const std::string& wanted) const;
  std::string type_name_;
  std::vector<std::string> values_;
  std::string file_, name_;
};

}  // namespace ppm
