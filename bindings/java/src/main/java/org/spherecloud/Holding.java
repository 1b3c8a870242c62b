package org.spherecloud;

/** Something outside the heap that has to be given back. */
interface Holding {
  void release();
}
