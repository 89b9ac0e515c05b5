#pragma once
#include <cstdint>
#include <string>

#include "sim_host/diff/aligned_frames.hpp"
#include "sim_host/diff/diff_result.hpp"
#include "sim_host/support/output_file.hpp"

namespace morepro::host {

/// A table for people: every signal of recordings, of results the values that differ.
std::string diff_text(const DiffResult& result);

/// morepro.diff/1.
std::string diff_json(const DiffResult& result);

/// "3 of 12 signals are out of tolerance, first feed_force_n at 1.2 s": why the two differ; empty where they
/// do not.
std::string diff_sentence(const DiffResult& result);

/// The differences B - A of the signals that both recordings have, row by row, as a recording: it can be
/// plotted and compared like one.
class DifferenceCsv {
 public:
  DifferenceCsv(OutputFile& file, const RecordingInfo& a, const RecordingInfo& b);
  /// Rows of one side only are left out.
  void write(const AlignedRow& row);

 private:
  OutputFile& file_;
  std::uint16_t recorded_;
};

}  // namespace morepro::host
