#include "app/command.hpp"

int main(int argc, char** argv) { return riesel::app::command(argc, argv); }
