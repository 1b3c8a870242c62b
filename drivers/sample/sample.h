/* sample.h - the driver to copy when writing one for a new camera.
 *
 * It needs no device: colour is a grey gradient that moves, depth a plane 2 m away, both at 30 Hz of a clock that
 * ticks with every capture.  sample.cpp shows the states and the book of loans that every driver keeps;
 * docs/drivers.md says what else a real one must do, and drivers/contract checks it.
 */
#ifndef SPHERECLOUD_DRIVERS_SAMPLE_SAMPLE_H
#define SPHERECLOUD_DRIVERS_SAMPLE_SAMPLE_H

#include <spherecloud/spherecloud_capture.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SPHC_SAMPLE_WIDTH 64u
#define SPHC_SAMPLE_HEIGHT 48u

typedef struct sphc_sample sphc_sample;

/* `frames`: how many of each stream until SPHC_END; 0: endless.  Allocates all it will need.
 * Errors: ARGUMENT (sample null), DEVICE (out of memory; a real driver: no such device). [pure] */
sphc_status sphc_sample_open(uint32_t frames, sphc_sample **sample, sphc_message *message);
/* Ends every loan.  Accepts null and pointer to null; sets *sample to null. [exclusive] */
void sphc_sample_close(sphc_sample **sample);

/* Fills *source (struct_size too); valid until sphc_sample_close.  Colour is GRAY8, depth DEPTH16 in millimetres.
 * Errors: ARGUMENT. [exclusive] */
sphc_status sphc_sample_source(sphc_sample *sample, sphc_source *source);

#ifdef __cplusplus
}
#endif
#endif /* SPHERECLOUD_DRIVERS_SAMPLE_SAMPLE_H */
