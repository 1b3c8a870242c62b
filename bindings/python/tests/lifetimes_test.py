"""Nothing goes while it is used, and all goes when it is not."""
import gc
import pickle
import threading
import time
import unittest
import weakref

import numpy as np

import session
import spherecloud as sphc


class Lifetimes(unittest.TestCase):
    def test_a_localizer_keeps_its_map(self):
        with sphc.Map.open(session.MAP) as room:
            made, kept = session.localizer({session.MAP_ID: room}), weakref.ref(room.owned())
        del room
        gc.collect()
        self.assertTrue(session.play(made))
        self.assertIsNotNone(kept())
        made.remove_map(session.MAP_ID)
        self.assertIsNone(kept())

    def test_a_map_that_is_replaced_goes(self):
        made, kept = session.localizer(), []
        for _ in range(3):
            room = sphc.Map.open(session.MAP)
            kept.append(weakref.ref(room.owned()))
            made.set_map(session.MAP_ID, room)
            del room
        self.assertEqual([ref() is None for ref in kept], [True, True, False])
        made.close()
        self.assertIsNone(kept[2]())

    def test_an_interrupt_right_after_a_map_is_set(self):
        class Interrupted:
            """The library, where a signal comes while a map is set: Python raises it when the call is over."""

            def __getattr__(self, name):
                return getattr(library, name)

            def sphc_localizer_set_map(self, *arguments):
                library.sphc_localizer_set_map(*arguments)
                raise KeyboardInterrupt
        made, room = session.localizer(), sphc.Map.open(session.MAP)
        library, kept = made._c, weakref.ref(room.owned())
        made._c = Interrupted()
        self.assertRaises(KeyboardInterrupt, made.set_map, session.MAP_ID, room)
        made._c = library
        del room
        gc.collect()
        self.assertIsNotNone(kept())  # before a frame would be looked for in it
        self.assertTrue(session.play(made))
        made.remove_map(session.MAP_ID)
        self.assertIsNone(kept())

    def test_a_map_that_is_refused_leaves_the_one_before(self):
        made, room = session.localizer(), sphc.Map.open(session.MAP)
        made.set_map(session.MAP_ID, room)
        closed, kept = sphc.Map.open(session.MAP), weakref.ref(room.owned())
        refused = weakref.ref(closed.owned())
        closed.owned().end()
        self.assertRaises(sphc.Error, made.set_map, session.MAP_ID, closed)
        del room, closed
        gc.collect()
        self.assertIsNone(refused())
        self.assertIsNotNone(kept())
        self.assertTrue(session.play(made))

    def test_orders_of_the_end(self):
        for order in ([0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]):
            room = sphc.Map.open(session.MAP)
            made = session.localizer({session.MAP_ID: room})
            features = made.make_features()
            made.extract(session.frame(session.ROWS[0]), features)
            objects = [room, made, features]
            del room, made, features
            for index in order:
                objects[index] = None
                gc.collect()

    def test_cycles_are_collected(self):
        lines = []
        made = session.localizer({0: sphc.Map.open(session.MAP)}, log=lambda level, text: lines.append((made, text)))
        gone = weakref.ref(made)
        lines.append(made)
        del made, lines
        gc.collect()
        self.assertIsNone(gone())

    def test_results_outlive_the_localizer(self):
        with sphc.Map.open(session.MAP) as room, session.localizer({session.MAP_ID: room}) as made:
            result = made.process(session.frame(session.ROWS[0]))
            seen = made.observations()
        covariance = result.covariance
        again = pickle.loads(pickle.dumps(result))
        self.assertEqual(again, result)
        del result
        gc.collect()
        self.assertEqual(covariance[0, 0], float(session.ROWS[0]["covariance_0"]))
        self.assertEqual(len(seen), int(session.ROWS[0]["keypoints"]))

    def test_images_may_go_after_the_call(self):
        with sphc.Map.open(session.MAP) as room, session.localizer({session.MAP_ID: room}) as made:
            features = made.make_features()
            frame = session.frame(session.ROWS[0])
            gone = weakref.ref(frame.color)
            made.extract(frame, features)
            frame.color = None
            self.assertIsNone(gone())
            self.assertTrue(session.same(made.locate(frame, features), session.ROWS[0]))

    def test_a_frame_may_change_during_a_call(self):
        with sphc.Map.open(session.MAP) as room, session.localizer({session.MAP_ID: room}) as made:
            frame, end = session.frame(session.ROWS[0]), threading.Event()
            images = frame.color, frame.depth

            def change():
                while not end.is_set():
                    frame.color, frame.depth = np.array(images[0]), np.array(images[1])
            other = threading.Thread(target=change)
            other.start()
            found = {made.process(frame).localized for _ in range(10)}
            end.set()
            other.join()
            self.assertEqual(found, {True})

    def test_closing_waits_for_the_call(self):
        begun, order = threading.Event(), []

        def clock():
            begun.set()
            time.sleep(0.02)
            return time.monotonic_ns()

        def work():
            order.append(made.process(session.frame(session.ROWS[0])).localized)
        made = session.localizer({session.MAP_ID: sphc.Map.open(session.MAP)}, clock=clock)
        other = threading.Thread(target=work)
        other.start()
        begun.wait()
        made.close()
        order.append("closed")
        other.join()
        self.assertEqual(order, [True, "closed"])

    def test_a_call_on_its_own_thread_may_close_an_aligner(self):
        """As a handler of a signal does, which runs between two steps of the call."""
        aligner, caught = sphc.Aligner(session.RIG), []

        class Closing(np.ndarray):
            @property
            def __array_interface__(self):
                aligner.close()
                return np.asarray(self).__array_interface__

        def work():
            try:
                aligner.process(depth)
            except sphc.Error as error:
                caught.append(error.status)
        depth = session.frame(session.ROWS[0]).depth.view(Closing)
        depth.flags.writeable = False  # so that its interface is asked for its address
        call = threading.Thread(target=work, daemon=True)
        call.start()
        call.join(10)
        self.assertEqual(caught, [sphc.Status.E_STATE])


if __name__ == "__main__":
    unittest.main()
