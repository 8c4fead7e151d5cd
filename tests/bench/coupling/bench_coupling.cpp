#include "bench/coupling/coupling_table.h"

#include <iostream>

int main() { ode::soft::print_coupling_table(std::cout); }
