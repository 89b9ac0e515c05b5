#pragma once
#include <string>

#include "sim_host/diagnose/result/diagnosis_result.hpp"

namespace morepro::host {

/// The result as JSON, schema "morepro.diagnosis/1".
std::string diagnosis_json(const DiagnosisResult& result);

/// The result for reading.
std::string diagnosis_text(const DiagnosisResult& result);

}  // namespace morepro::host
