#pragma once

namespace ppm {

/// Sources of new modules, in which "category.name" and NewModule stand for the names. Each compiles without a warning.
extern const char* const kSourceTemplate;
extern const char* const kSensorTemplate;
extern const char* const kPreprocessTemplate;
extern const char* const kMotionTemplate;
extern const char* const kPredictionTemplate;
extern const char* const kWeightingTemplate;
extern const char* const kMapUpdateTemplate;
extern const char* const kSinkTemplate;
extern const char* const kBeliefTemplate;

}  // namespace ppm
