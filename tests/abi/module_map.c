/* The C interface imported as a module, as Swift does: no header is included. */
#pragma clang module import SphereCloud

int main(void) {
  sphc_localizer_config config;
  return sphc_localizer_config_init(&config, sizeof config) == SPHC_OK && sphc_abi() == SPHC_ABI ? 0 : 1;
}
