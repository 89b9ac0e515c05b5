#pragma once
#include "firmware/block_board.hpp"
#include "hal/board.hpp"
#include "sim_host/boards/file_blocks.hpp"

namespace morepro::host {

/// A native recording as a board: its frames and configuration come from a file, messages go to another one.
/// flush() and FileBlocks::close() end it.
using RecordingBoard = firmware::BlockBoard<FileBlocks>;

static_assert(hal::Board<RecordingBoard>);

}  // namespace morepro::host
