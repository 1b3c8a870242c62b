// furniture.h - the pieces.  Each is built at a place whose origin is on the floor in the middle of its back edge
// (or in its middle, where said), x to the side and y to the front.  Sizes in metres.
#pragma once

#include "drivers/simulated/builder.h"

namespace sphc::simulated {

void addBookshelf(Builder &builder, const Place &place, double width, double height);
// Binders are equal everywhere, as those of one maker are.
void addBinderShelf(Builder &builder, const Place &place, double width);
void addSofa(Builder &builder, const Place &place, double width);
void addCabinet(Builder &builder, const Place &place, double width, double height, int columns, int rows);
void addTvBench(Builder &builder, const Place &place, double width);
void addDesk(Builder &builder, const Place &place, double width);
void addDiningSet(Builder &builder, const Place &place);
void addDoor(Builder &builder, const Place &place);
void addDoorway(Builder &builder, const Place &place, double half, double height);  // the frame around a gap
void addBoxes(Builder &builder, const Place &place);
void addWindow(Builder &builder, const Place &place, double width);  // no floor space needed
void addMirror(Builder &builder, const Place &place, double width, double height);
void addPicture(Builder &builder, const Place &place, double width, double height, double middle_height);
void addClock(Builder &builder, const Place &place, double middle_height);
void addWallShelf(Builder &builder, const Place &place, double width, double height);

// These have their origin in their middle.
void addCoffeeTable(Builder &builder, const Place &place);
void addCarpet(Builder &builder, const Place &place, double half_x, double half_y);
void addChair(Builder &builder, const Place &place);
void addPlant(Builder &builder, const Place &place);
void addFloorLamp(Builder &builder, const Place &place);
void addCeilingLamp(Builder &builder, const Place &place, double ceiling);
// Books, vases, boxes on a surface `width` wide.
void addClutter(Builder &builder, const Place &place, double width, double depth, int count);
// A row of books standing between x0 and x1, their spines at y = front.
void addBooks(Builder &builder, const Place &place, double x0, double x1, double front, double z, double room);

}  // namespace sphc::simulated
