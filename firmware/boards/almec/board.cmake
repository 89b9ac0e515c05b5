set(MOREPRO_LINKER_SCRIPT "${CMAKE_CURRENT_LIST_DIR}/almec.ld")
set(MOREPRO_BOARD_SOURCES boards/almec/almec_board.cpp)
