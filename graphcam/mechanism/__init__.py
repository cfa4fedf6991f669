"""The exact side: what the drawn constructions are compared with, by closed forms and root finding alone.

Every follower has one file that says what its cam needs to know of it (:mod:`~graphcam.mechanism.translating`), as
:mod:`~graphcam.mechanism.kinematics` asks for it; what is the same for all of them stands in
:mod:`~graphcam.mechanism.cam`.
"""
