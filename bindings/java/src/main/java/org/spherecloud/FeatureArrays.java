package org.spherecloud;

import java.nio.ByteBuffer;
import java.util.List;

/** Keypoints, the strongest response first, with the descriptor and the camera of each; made once, filled again and again. */
public final class FeatureArrays {
  private final StructList<Keypoint> keypoints;
  private final ByteBuffer descriptors;
  private final ByteBuffer cameras;
  private int extractor;

  /** Room for so many: config.maxKeypoints takes all. */
  public FeatureArrays(int capacity) {
    int descriptorBytes = StructList.bytes(capacity, Limits.DESCRIPTOR_BYTES);
    keypoints = new StructList<>(capacity, Layout.KEYPOINT_BYTES, Keypoint::new);
    descriptors = ByteBuffer.allocateDirect(descriptorBytes);
    cameras = ByteBuffer.allocateDirect(Math.max(1, capacity));
    extractor = Native.extractorId();
  }

  /** The keypoints that count; their values can be set. */
  public List<Keypoint> getKeypoints() {
    return keypoints.getFilled();
  }

  /** How many count, the first ones; those that were not set before are zero. */
  public void setCount(int count) {
    if (count < 0 || count > keypoints.capacity()) throw tooMany(count);
    keypoints.fill(count);
  }

  /** How many count. */
  public int getCount() {
    return keypoints.getFilled().size();
  }

  /** 128 bytes for each keypoint, one behind the other; the same memory at each call. */
  public ByteBuffer getDescriptors() {
    return descriptors.duplicate();
  }

  /** A byte for each keypoint: 0 the colour camera, i config.cameras[i - 1]; the same memory at each call. */
  public ByteBuffer getCameras() {
    return cameras.duplicate();
  }

  /** The id of the extractor that described them; at first {@link Spherecloud#extractorId}. */
  public int getExtractor() {
    return extractor;
  }

  /** Sets {@link #getExtractor}. */
  public void setExtractor(int extractor) {
    this.extractor = extractor;
  }

  /** As the library is told of them. */
  Struct told() {
    Struct told = new Struct(Layout.FEATURES_ARRAYS_BYTES);
    told.putInt(Layout.FEATURES_ARRAYS_STRUCT_SIZE, Layout.FEATURES_ARRAYS_BYTES);
    told.putInt(Layout.FEATURES_ARRAYS_EXTRACTOR, extractor);
    told.putInt(Layout.FEATURES_ARRAYS_COUNT, getCount());
    told.putInt(Layout.FEATURES_ARRAYS_KEYPOINT_STRIDE_BYTES, Layout.KEYPOINT_BYTES);
    told.putInt(Layout.FEATURES_ARRAYS_DESCRIPTOR_STRIDE_BYTES, Limits.DESCRIPTOR_BYTES);
    told.putPointer(Layout.FEATURES_ARRAYS_KEYPOINTS, keypoints);
    told.putPointer(Layout.FEATURES_ARRAYS_DESCRIPTORS, Memory.address(descriptors));
    told.putPointer(Layout.FEATURES_ARRAYS_CAMERAS, Memory.address(cameras));
    return told;
  }

  /** Copies what the library lends. */
  void take(Struct lent) {
    int count = lent.getInt(Layout.FEATURES_ARRAYS_COUNT);
    if (count > keypoints.capacity()) throw tooMany(count);
    extractor = lent.getInt(Layout.FEATURES_ARRAYS_EXTRACTOR);
    gather(keypoints.address, Layout.KEYPOINT_BYTES, lent.getPointer(Layout.FEATURES_ARRAYS_KEYPOINTS),
        lent.getInt(Layout.FEATURES_ARRAYS_KEYPOINT_STRIDE_BYTES), count);
    gather(Memory.address(descriptors), Limits.DESCRIPTOR_BYTES, lent.getPointer(Layout.FEATURES_ARRAYS_DESCRIPTORS),
        lent.getInt(Layout.FEATURES_ARRAYS_DESCRIPTOR_STRIDE_BYTES), count);
    long of = lent.getPointer(Layout.FEATURES_ARRAYS_CAMERAS);
    if (of != 0) Memory.copy(Memory.address(cameras), of, count);
    else for (int i = 0; i < count; i++) cameras.put(i, (byte) 0);
    keypoints.fill(count);
  }

  /** Elements that lie so far apart, one behind the other. */
  private static void gather(long to, int bytes, long from, int strideBytes, int count) {
    for (int i = 0; i < count; i++) Memory.copy(to + (long) bytes * i, from + (long) strideBytes * i, bytes);
  }

  private SpherecloudException tooMany(int count) {
    return new SpherecloudException(Status.E_CAPACITY.value,
        count + " keypoints; there is room for " + keypoints.capacity() + ", so make FeatureArrays for more");
  }
}
