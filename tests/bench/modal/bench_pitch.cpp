#include "bench/modal/pitch_table.h"

#include <iostream>

int main() { ode::soft::print_pitch_table(std::cout); }
