// The program whose precompiled headers all test programs read.
int main() {}
