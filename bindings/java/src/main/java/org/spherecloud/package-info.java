/**
 * The SphereCloud relocalizer: where is a camera in a map that was built beforehand?
 *
 * <p>Begin with {@link org.spherecloud.SphereMap}, {@link org.spherecloud.LocalizerConfig},
 * {@link org.spherecloud.Localizer}, {@link org.spherecloud.Frame} and {@link org.spherecloud.Result}.  Frames are named
 * target_from_source, camera axes are OpenCV's (x right, y down, z forward), and units stand in names: metres,
 * nanoseconds, radians, pixels.
 */
package org.spherecloud;
