#include "framework/slam/column.hpp"

#include "framework/core/error.hpp"

namespace ppm {

void SavedColumn::check_type(const std::string& wanted) const {
  if (wanted != type_name_)
    throw DataError(file_, fmt::format("column '{}' was saved as type '{}', and is used as '{}'", name_, type_name_, wanted));
}

}  // namespace ppm
