"""Code that is handed in and means harm: it breaks out, takes all there is, or forges what comes out."""

from __future__ import annotations

from graphcam.exercises.running.launcher import ANSWER_MIME_TYPE

CODE: dict[str, str] = {
    "an endless loop": "while True: pass",
    "a loop that ignores being interrupted": """
import signal
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGALRM, signal.SIGXCPU):
    signal.signal(number, signal.SIG_IGN)
while True:
    try:
        while True: pass
    except BaseException: pass""",
    "20 GB": "x = bytearray(20 << 30)",
    "memory bit by bit": "x = []\nwhile True: x.append(bytearray(10 << 20))",
    "a fork bomb": "import os\nwhile True:\n    try: os.fork()\n    except OSError: pass",
    "threads without end": "import threading as t, time\nwhile True: t.Thread(target=time.sleep, args=(60,)).start()",
    "60 MB of output": "for _ in range(60): print('x' * 1_000_000)",
    "sys.exit": "import sys\nsys.exit(0)",
    "os._exit": "import os\nos._exit(0)",
    "a crash of the interpreter": "import ctypes\nctypes.string_at(0)",
    "a process that stays": """
import os, time
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        time.sleep(300)
    os._exit(0)""",
    "abs redefined": "import builtins, math\nbuiltins.abs = lambda x: 0.0\nmath.isclose = lambda *a, **k: True",
    "reading the key": "{0} = open({key!r}).read()",
    "reading the secret": "{0} = open({secret!r}).read()",
    "reading a neighbour": "{0} = open({neighbour!r}).read()",
    "looking for the key": """
import os
{0} = [os.path.join(a, f) for a, _, fs in os.walk('/') if not a.startswith(('/proc', '/sys', '/usr')) for f in fs
       if 'secret' in f or 'certificate' in f and f.endswith('.json')]""",
    "writing the grade book": "open({grades!r}, 'w').write('all right')",
    "the network": "import socket\nsocket.create_connection(('127.0.0.1', {port}), 2).send(b'hello')",
    "path traversal": "open('../../../../../../tmp/graphcam-owned', 'w')",
    "infinite answers": "{0} = float('inf')",
    "answers that are no JSON": "import os\nos.write({pipe}, b'{{not json\\n')",
    "answers without end": "import os\nwhile True: os.write({pipe}, b'[' * 65536)",
    "answers twice in one": 'import os\nos.write({pipe}, b\'{{"{0}": 1, "{0}": 2}}\\n\')',
    "deep answers": "import os\nos.write({pipe}, b'[' * 100000 + b'\\n')",
    "a display of nonsense": "display({{'" + ANSWER_MIME_TYPE + "': {{'{0}': 'all right', 'total': 100}}}}, raw=True)",
}
"""What is run; the names in braces are filled in."""

TOLD = """
import ctypes, errno, fcntl, gc, mmap, os, resource, select, signal, socket, stat, struct, sys, threading, time
answer, key, secret, neighbour, grades, port = {told!r}
def is_pipe(n):
    try:
        return stat.S_ISFIFO(os.fstat(n).st_mode)
    except OSError:
        return False
pipes = [n for n in range(3, 100) if is_pipe(n)]
library = ctypes.CDLL(None, use_errno=True)
def system(*arguments):
    if library.syscall(*arguments) < 0:
        raise OSError(ctypes.get_errno(), "refused")
def families(*numbers):
    return [socket.socket(number, kind) for number in numbers for kind in (1, 2, 3)]
def child(work):
    number = os.fork()
    if number == 0:
        try:
            work()
        finally:
            os._exit(0)
    return number
"""
"""What code of the table below is told before it begins: more than a student knows."""

FILL = "x = [b'1' * (50 << 20) for _ in range(4)]\ntime.sleep(60)"
"""Takes 200 MB, and waits."""

MORE_CODE: dict[str, str] = {
    # Memory.
    "a file in memory": "f = os.memfd_create('x')\nwhile True: os.write(f, bytes(1 << 20))",
    "a secret file in memory": "system(447, 0)",
    "shared memory of System V": "system(29, 0, 1 << 30, 0o1600)",
    "queues of messages": "while True: system(68, 0, 0o1600)",
    "semaphores": "while True: system(64, 0, 32000, 0o1600)",
    "a queue by name": "system(240, b'graphcam-owned', 0o102, 0o666, None)",
    "shared memory that is filled": "f = open('/dev/shm/owned', 'wb')\nwhile True: f.write(bytes(1 << 20))",
    "small files without end": "k = 0\nwhile True:\n    open('/dev/shm/%d' % k, 'w').close(); k += 1",
    "folders without end": "k = 0\nwhile True:\n    os.mkdir('/tmp/%d' % k); k += 1",
    "the folder for temporary files filled": "for k in range(99): open('/tmp/%d' % k, 'wb').write(bytes(8 << 20))",
    "a sparse file": "os.truncate(os.open('/tmp/x', 66, 0o600), 1 << 40)",
    "a map shared by children": "m = mmap.mmap(-1, 900 << 20)\nfor _ in range(9): os.fork()\n"
    "for k in range(0, len(m), 4096): m[k] = 1\ntime.sleep(60)",
    "twelve children with 200 MB each": "for _ in range(12):\n    if os.fork() == 0: break\n" + FILL,
    "children that disown their parents": "for _ in range(12):\n    if os.fork() == 0:\n        os.setsid()\n"
    "        if os.fork() == 0: break\n        os._exit(0)\n" + FILL,
    "memory in pipes": "p = []\nwhile True:\n    r, w = os.pipe(); p += [r, w]\n    fcntl.fcntl(w, 1031, 1 << 20)\n"
    "    os.write(w, bytes(1 << 20))",
    "memory in sockets": "while True:\n    a, b = socket.socketpair(); a.setblocking(False); gc.disable()\n"
    "    globals().setdefault('kept', []).extend((a, b))\n    a.send(bytes(1 << 17))",
    "memory that is locked": "m = mmap.mmap(-1, 500 << 20)\nlibrary.mlockall(3)\nwhile True: m[:] = bytes(len(m))",
    "a stack without end": "sys.setrecursionlimit(10 ** 9)\nf = lambda n: f(n + 1)\nf(0)",
    "limits lifted": "resource.setrlimit(resource.RLIMIT_AS, (-1, -1))\nx = bytearray(20 << 30)",
    "another's limits lifted": "resource.prlimit(1, resource.RLIMIT_NPROC, (-1, -1))",
    "an integer of a gigabyte": "x = 1 << (1 << 34)",
    "a text as long as it goes": "x = str(10 ** 4000) * 10 ** 6",
    # Processes and signals.
    "everybody killed": "os.kill(-1, signal.SIGKILL)",
    "the group killed": "os.killpg(0, signal.SIGKILL)",
    "the first process killed": "os.kill(1, signal.SIGKILL)\nos.kill(1, signal.SIGSTOP)",
    "the parent stopped": "os.kill(os.getppid(), signal.SIGSTOP)\ntime.sleep(60)",
    "itself stopped": "os.kill(os.getpid(), signal.SIGSTOP)",
    "signals to the input's owner": "fcntl.fcntl(pipes[0], 8, 1)\nfcntl.fcntl(pipes[0], 10, signal.SIGKILL)",
    "a session of its own": "child(lambda: (os.setsid(), time.sleep(300)))\ntime.sleep(60)",
    "a chain of forks": "while True:\n    if os.fork(): os._exit(0)",
    "a death that is refused": "library.prctl(1, 0)\nlibrary.prctl(36, 1)\nchild(lambda: time.sleep(300))",
    "another name for itself": "library.prctl(15, b'bwrap')\nopen('/proc/self/comm', 'w').write('init')\n"
    "time.sleep(60)",
    "a child that holds the pipe": "child(lambda: time.sleep(300))\nos._exit(0)",
    "children that nobody waits for": "for _ in range(12): child(lambda: None)\ntime.sleep(60)",
    "priority over all": "os.setpriority(0, 0, -20)\nos.sched_setscheduler(0, 1, os.sched_param(99))\nwhile True: pass",
    "a clock of signals": "signal.setitimer(signal.ITIMER_REAL, 1e-6, 1e-6)\nwhile True: pass",
    "another program in its place": "os.execv('/bin/sh', ['sh', '-c', 'while :; do :; done'])",
    "a shell that stays": "os.system('(sleep 300 & sleep 300 &) ; nohup sleep 300 &')",
    "a trace of another": "system(101, 16, 1, 0, 0)",
    "another's memory": "open('/proc/%d/mem' % os.getppid(), 'r+b').read(1)",
    "another's memory by a call": "system(310, os.getppid(), None, 0, None, 0, 0)\nsystem(438, 1, 0, 0)",
    "another's environment": "globals()[answer] = open('/proc/1/environ').read() + open('/proc/1/cmdline').read()",
    "all that is open": "for n in range(1024):\n    try: os.write(n, b'MARK')\n    except OSError: pass",
    "the root of another": "globals()[answer] = open('/proc/1/root' + key).read()",
    "the folder of another": "globals()[answer] = os.listdir('/proc/1/cwd/..')",
    # The kernel.
    "a name space of users": "system(272, 0x10000000)",
    "a name space of users by clone": "system(56, 0x10000011, 0, 0, 0, 0)",
    "a name space by clone3": "system(435, struct.pack('Q' * 11, 0x10000000, *[0] * 10), 88)",
    "a mount": "system(165, b'none', b'/tmp', b'tmpfs', 0, None)",
    "a mount of the new kind": "system(430, b'tmpfs', 0)\nsystem(429, -1, b'', -1, b'/tmp', 0)",
    "a tree opened to be mounted": "system(428, -100, b'/', 1)",
    "a mount made writable": "system(442, -100, b'/usr', 0, struct.pack('QQQQ', 0, 1, 0, 0), 32)",
    "an unmount": "system(166, b'/tmp', 2)",
    "another root": "os.chroot('/tmp')\nsystem(155, b'/', b'/tmp')",
    "a file by its handle": "system(304, -100, bytes(128), 0)",
    "keys of the session": "system(250, 0, -3, 1)\nsystem(250, 11, -3, None, 0)",
    "a key that is left": "system(248, b'user', b'graphcam-owned', b'x', 1, -4)",
    "a ring of requests": "system(425, 8, bytes(120))",
    "a program in the kernel": "system(321, 5, bytes(120), 120)",
    "events of the processor": "system(298, bytes(120), 0, -1, -1, 0)",
    "faults of pages": "system(323, 0)",
    "a kernel of its own": "system(246, 0, 0, 0, 0)\nsystem(320, -1, -1, 0, None, 0)",
    "a module for the kernel": "system(175, b'', 0, b'')\nsystem(313, -1, b'', 0)",
    "the clock": "time.clock_settime(0, 0)\nsystem(159, bytes(208))",
    "the name of the machine": "system(170, b'owned', 5)\nsystem(171, b'owned', 5)",
    "a restart": "system(169, 0xfee1dead, 672274793, 0x1234567, None)",
    "swap": "system(167, b'/tmp/x', 0)",
    "quotas and accounts": "system(163, b'/tmp/x')",
    "ports of the machine": "system(172, 3)\nsystem(173, 0, 1, 1)",
    "the log of the kernel": "system(103, 3, bytes(10), 10)\nopen('/dev/kmsg', 'w').write('owned')",
    "settings of the kernel": "open('/proc/sys/kernel/core_pattern', 'w').write('|/tmp/x')",
    "the system's switch": "open('/proc/sysrq-trigger', 'w').write('c')",
    "calls of 32 bits": "x = mmap.mmap(-1, 4096, prot=7)\nx.write(bytes.fromhex('b814000000cd80c3'))\n"
    "ctypes.CFUNCTYPE(ctypes.c_int)(ctypes.addressof(ctypes.c_char.from_buffer(x)))()",
    "calls of another kind": "system(0x40000000 + 39)",
    "rights taken back": "os.setresuid(0, 0, 0)\nos.setgroups([0])",
    "a program with root's rights": "open('/tmp/x', 'w').write('#!/bin/sh')\nos.chmod('/tmp/x', 0o6777)\n"
    "os.chown('/tmp/x', 0, 0)",
    "a password": "os.execv('/usr/bin/su', ['su', '-c', 'id'])",
    "devices": "os.mknod('/tmp/disk', 0o60666, os.makedev(8, 0))\nopen('/tmp/disk', 'rb').read(1)",
    # The network.
    "a name of a socket without a file": "s = socket.socket(socket.AF_UNIX)\ns.bind('\\0graphcam-owned')\n"
    "s.connect('\\0/tmp/.X11-unix/X0')",
    "the kernel's sockets": "s = socket.socket(16, 3, 0)\ns.bind((0, -1))\ns.send(bytes(16))",
    "sockets to the host": "s = socket.socket(40, 1)\ns.settimeout(1)\ns.connect((2, 22))",
    "packets as they are": "socket.socket(17, 3, 768)",
    "rare families": "families(9, 21, 29, 30, 31, 36, 38, 44)",
    "ciphers of the kernel": "s = socket.socket(38, 5)\ns.bind(('hash', 'sha256'))\ntime.sleep(60)",
    "the buses of the system": "for p in ('/run/dbus/system_bus_socket', '/var/run/docker.sock'):\n"
    "    s = socket.socket(socket.AF_UNIX); s.connect(p)",
    "the network of version 6": "socket.create_connection(('::1', port), 1).send(b'MARK')",
    "a question for a name": "socket.getaddrinfo('example.org', 80)",
    "an interface brought up": "fcntl.ioctl(socket.socket(), 0x8914, struct.pack('16sh', b'lo', 65))",
    "letters typed for another": "for n in (0, 1, 2): fcntl.ioctl(n, 0x5412, b'x')",
    "another terminal": "os.open('/dev/ptmx', 2)\nfcntl.ioctl(os.open('/dev/tty', 2), 0x540e, 0)",
    # Forged answers, and the launcher.
    "a grade for an answer": 'os.write(pipes[0], b\'{"total": 100, "marks": 100, "outcome": "right"}\\n\')',
    "a record for an answer": 'os.write(pipes[0], b\'{"answers": {"\' + answer.encode() + b\'": {"marks": 9}}}\\n\')',
    "numbers too large in JSON": "os.write(pipes[0], b'{\"' + answer.encode() + b'\": 1e999}\\n')",
    "numbers that are none in JSON": "os.write(pipes[0], b'{\"' + answer.encode() + b'\": NaN}\\n')",
    "an integer of a megabyte": "os.write(pipes[0], b'{\"' + answer.encode() + b'\": ' + b'9' * 900000 + b'}\\n')",
    "answers that are no text": "os.write(pipes[0], b'\\xff\\xfe{}\\n')",
    "half surrogates": "os.write(pipes[0], b'{\"' + answer.encode() + b'\": \"\\\\ud800\"}\\n')",
    "half a line": "os.write(pipes[0], b'{\"' + answer.encode())\nos._exit(0)",
    "a pipe that is closed": "os.close(pipes[0])",
    "a pipe that is stuffed": "fcntl.fcntl(pipes[0], 1031, 1 << 20)\nwhile True: os.write(pipes[0], b'{}\\n' * 1000)",
    "a pipe that is read": "way = os.open('/proc/self/fd/%d' % pipes[0], os.O_RDONLY | os.O_NONBLOCK)\n"
    "globals()[answer] = str(os.read(way, 99))",
    "a pipe that does not wait": "os.set_blocking(pipes[0], False)\nfcntl.fcntl(pipes[0], fcntl.F_SETFL, os.O_ASYNC)",
    "lines from a thread": "def f():\n    while True: os.write(pipes[0], b'[]\\n')\n"
    "threading.Thread(target=f, daemon=True).start()\ntime.sleep(60)",
    "JSON redefined": "import json\njson.dumps = lambda *a, **k: '{\"total\": 1}'\njson.loads = None",
    "modules thrown away": "sys.modules.clear()",
    "the launcher found by the collector": "for o in gc.get_objects():\n"
    "    if isinstance(o, dict) and 'pipe' in o: o.update(pipe=1, names=[answer, 'key'])",
    "what is done at the end": "import atexit\natexit.register(lambda: os.write(pipes[0], b'{\"total\": 9}\\n'))",
    "threads that outlive the main one": "threading.Thread(target=time.sleep, args=(300,)).start()",
    "the way out redefined": "os._exit = lambda *_: time.sleep(300)",
    "os.write redefined": "write = os.write\nos.write = lambda n, d: [write(n, d) for _ in range(10 ** 6)]",
    "a trace of every line": "sys.settrace(lambda *a: time.sleep(1))\ndef f(): pass\nf()",
    "a class that lies": "class F(float):\n    __eq__ = __lt__ = lambda *_: True\n    __abs__ = lambda s: 0.0\n"
    "globals()[answer] = F(1)",
    "an object that has no end": "class T:\n    def tolist(self): return [T()]\nglobals()[answer] = T()",
    "a list of itself": "x = []\nx.append(x)\nglobals()[answer] = x",
    "an object that exits": "class T:\n    def __str__(self): os._exit(7)\nglobals()[answer] = T()",
    "standard output closed": "os.close(1)\nos.close(2)\nprint('x' * 10 ** 7)",
    "an error of a megabyte": "raise ValueError('MARK'[::-1] * 10 ** 6)",
    "an error that lies": "class E(Exception):\n    def __str__(self): raise KeyboardInterrupt\nraise E",
    "terminal codes in an error": "raise ValueError('\\x1b]0;x\\x07\\x1b[2J\\n=HYPERLINK(1)')",
    "a syntax that crashes": "eval('(' * 10 ** 5)\ncompile('-' * 10 ** 6 + '1', '', 'eval')",
    "a pattern that never matches": "import re\nre.match('(a+)+$', 'a' * 60 + 'b')",
    # Files.
    "a link over the folder": "os.chdir('/')\nos.rename(os.environ['HOME'], '/tmp/graphcam-owned')\n"
    "os.symlink('/', os.environ['HOME'])",
    "a race of links": "end = time.time() + 1\nwhile time.time() < end:\n    os.symlink(key, '/tmp/a')\n"
    "    os.rename('/tmp/a', '/tmp/b')",
    "permissions for nobody": "os.makedirs('/tmp/a/b/c')\nos.chmod('/tmp/a/b', 0)\nos.chmod('/tmp', 0)",
    "Python itself changed": "open(os.__file__, 'a').write('x')\nos.chmod(sys.executable, 0o777)",
    "the launcher changed": "open('/launcher.py', 'a').write('x')",
    "a package in front": "open('/tmp/numpy.py', 'w').write('x')\nsys.path.insert(0, '/tmp')\nimport numpy",
    "the loader's list": "open('/etc/ld.so.preload', 'w').write('/tmp/x.so')",
    "names of bytes": "open(b'/tmp/\\xff\\xfe\\n=1', 'w').close()",
    "a lock on everything": "fcntl.flock(os.open(sys.executable, 0), 2)\ntime.sleep(60)",
    "a folder that nobody leaves": "for _ in range(3000):\n    os.mkdir('d'); os.chdir('d')",
    "watches without end": "n = library.inotify_init()\nfor k in range(10 ** 5):\n    os.mkdir('/tmp/%d' % k)\n"
    "    library.inotify_add_watch(n, b'/tmp/%d' % k, 0xfff)\nselect.select([], [], [])",
}
"""What is run after being told; numbers of calls are those of x86_64."""
