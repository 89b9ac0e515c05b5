set(MOREPRO_LINKER_SCRIPT "${CMAKE_CURRENT_LIST_DIR}/mps2.ld")
set(MOREPRO_BOARD_SOURCES boards/mps2/mps2_board.cpp boards/mps2/preserved_store.cpp)
