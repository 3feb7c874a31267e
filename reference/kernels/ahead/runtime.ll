; What kernels call of numba's runtime, for code that runs without it: memory that is freed with its last user (all of
; it scratch of one call, in one thread), and the strides of a contiguous array's new shape. A block begins as numba's
; does, with the count of users and, 24 bytes on, where its numbers are.

declare noalias ptr @malloc(i64)
declare void @free(ptr)

define ptr @NRT_MemInfo_alloc_aligned(i64 %size, i32 %align) {
  %more = add i64 %size, 128
  %block = call ptr @malloc(i64 %more)
  %none = icmp eq ptr %block, null
  br i1 %none, label %end, label %fill
fill:
  store i64 1, ptr %block
  %place = getelementptr i8, ptr %block, i64 24
  %address = ptrtoint ptr %block to i64
  %after = add i64 %address, 127
  %line = and i64 %after, -64
  %numbers = inttoptr i64 %line to ptr
  store ptr %numbers, ptr %place
  br label %end
end:
  ret ptr %block
}

define void @NRT_incref(ptr %block) {
  %none = icmp eq ptr %block, null
  br i1 %none, label %end, label %count
count:
  %users = load i64, ptr %block
  %more = add i64 %users, 1
  store i64 %more, ptr %block
  br label %end
end:
  ret void
}

define void @NRT_decref(ptr %block) {
  %none = icmp eq ptr %block, null
  br i1 %none, label %end, label %count
count:
  %users = load i64, ptr %block
  %fewer = sub i64 %users, 1
  store i64 %fewer, ptr %block
  %last = icmp eq i64 %fewer, 0
  br i1 %last, label %give, label %end
give:
  call void @free(ptr %block)
  br label %end
end:
  ret void
}

define i32 @numba_attempt_nocopy_reshape(i64 %axes, ptr %sizes, ptr %strides, i64 %new_axes, ptr %new_sizes,
                                                  ptr %new_strides, i64 %item, i32 %by_columns) {
  br label %head
head:
  %axis = phi i64 [ %new_axes, %0 ], [ %before, %body ]
  %stride = phi i64 [ %item, %0 ], [ %wider, %body ]
  %more = icmp sgt i64 %axis, 0
  br i1 %more, label %body, label %end
body:
  %before = sub i64 %axis, 1
  %to = getelementptr i64, ptr %new_strides, i64 %before
  store i64 %stride, ptr %to
  %from = getelementptr i64, ptr %new_sizes, i64 %before
  %size = load i64, ptr %from
  %wider = mul i64 %stride, %size
  br label %head
end:
  ret i32 1
}

; How Python's objects and numpy's arrays lie in memory; load.py makes sure of it.

@objects = global [2 x ptr] zeroinitializer  ; numpy.ndarray, TypeError: written by load.py
@message = internal constant [81 x i8] c"a kernel takes arrays of 64-bit numbers, of its axes and contiguous, and numbers\00"

declare ptr @PyErr_Occurred()
declare void @PyErr_SetString(ptr, ptr)

define i1 @fits(ptr %array, i32 %number, i32 %axes, i32 %flags) {
  %a = getelementptr i8, ptr %array, i64 8
  %type = load ptr, ptr %a
  %ndarray = load ptr, ptr @objects
  %is_array = icmp eq ptr %type, %ndarray
  br i1 %is_array, label %look, label %no
look:
  %b = getelementptr i8, ptr %array, i64 24
  %its_axes = load i32, ptr %b
  %c = getelementptr i8, ptr %array, i64 56
  %descriptor = load ptr, ptr %c
  %d = getelementptr i8, ptr %descriptor, i64 28
  %its_number = load i32, ptr %d
  %e = getelementptr i8, ptr %array, i64 64
  %its_flags = load i32, ptr %e
  %f = and i32 %its_flags, %flags
  %g = icmp eq i32 %f, %flags
  %h = icmp eq i32 %its_axes, %axes
  %i = icmp eq i32 %its_number, %number
  %j = getelementptr i8, ptr %descriptor, i64 26
  %its_order = load i8, ptr %j
  %k = icmp eq i8 %its_order, 61  ; "=", the processor's own order of bytes
  %l = and i1 %g, %h
  %m = and i1 %i, %k
  %n = and i1 %l, %m
  ret i1 %n
no:
  ret i1 false
}

define ptr @data(ptr %array) {
  %a = getelementptr i8, ptr %array, i64 16
  %data = load ptr, ptr %a
  ret ptr %data
}

define i64 @size(ptr %array, i64 %axis) {
  %a = getelementptr i8, ptr %array, i64 32
  %sizes = load ptr, ptr %a
  %b = getelementptr i64, ptr %sizes, i64 %axis
  %size = load i64, ptr %b
  ret i64 %size
}

define i64 @stride(ptr %array, i64 %axis) {
  %a = getelementptr i8, ptr %array, i64 40
  %strides = load ptr, ptr %a
  %b = getelementptr i64, ptr %strides, i64 %axis
  %stride = load i64, ptr %b
  ret i64 %stride
}

define ptr @refused() {
  %error = call ptr @PyErr_Occurred()
  %told = icmp ne ptr %error, null
  br i1 %told, label %end, label %tell
tell:
  %a = getelementptr ptr, ptr @objects, i64 1
  %kind = load ptr, ptr %a
  call void @PyErr_SetString(ptr %kind, ptr @message)
  br label %end
end:
  ret ptr null
}
