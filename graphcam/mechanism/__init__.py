"""The exact side: what the drawn constructions are compared with, by closed forms and root finding alone.

Every follower has one file that gives its trace point as a complex number (:mod:`~graphcam.mechanism.translating`);
what follows from the trace point in the same way for all of them stands in :mod:`~graphcam.mechanism.cam`.
"""
